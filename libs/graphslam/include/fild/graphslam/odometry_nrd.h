// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graphslam/motion_since_node.h"

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/interfaces/CNodeRegistrationDecider.h>

#include <map>
#include <memory>
#include <string>

namespace fild
{
/** Node registration decider for mrpt::graphslam::CGraphSlamEngine: a node each time the odometry
 *  says that the robot went so far or turned so much, in 2D and 3D.
 *
 *  MRPT 2.5 has none for 3D, and CFixedIntervalsNRD gives every edge the same information, whatever
 *  the way. Here an edge has the motion's own covariance, or that of the model in TGraphOptions. In
 *  2D it is the marginal of x, y and yaw.
 *
 *  - Map type: 2D, 3D
 *  - MRPT rawlog format: #1 (actions and sensory frames), #2 (observations)
 *  - Graph type: CPosePDFGaussianInf, CPose3DPDFGaussianInf
 *  - Observations: CObservationOdometry, CObservationRobotPose, CActionRobotMovement2D and 3D,
 *    CObservationGPS; the first source that comes is used throughout, see TrajectoryBuilder
 *
 *  Keys of section NodeRegistrationDeciderParameters of the engine's .ini file:
 *
 *  | key | default | meaning |
 *  |---|---|---|
 *  | `class_verbosity` | 1 | 0 debug, 1 info, 2 warnings, 3 errors |
 *  | `fild_config` | required | configuration of mrpt-fild whose [graph] section tells how certain
 *    the odometry is; relative to the engine's .ini file |
 *  | `registration_max_distance` | 0.5 | metres from the node before |
 *  | `registration_max_angle` | 15 | degrees, of the whole rotation against the node before |
 *
 *  For CNetworkOfPoses2DInf and CNetworkOfPoses3DInf. Deterministic. Not thread-safe: one caller
 *  at a time, as CGraphSlamEngine is. */
template <class GRAPH_T>
class COdometryNRD : public mrpt::graphslam::deciders::CNodeRegistrationDecider<GRAPH_T>
{
 public:
    using parent_t = mrpt::graphslam::deciders::CNodeRegistrationDecider<GRAPH_T>;

    COdometryNRD();

    /** \throw std::runtime_error as load_decider_options(), and naming a key whose value is not
     *         positive. */
    void loadParams(const std::string& source_fname) override;
    void printParams() const override;
    void getDescriptiveReport(std::string* report_str) const override;

    /** \return true when a node was registered; with the first one comes the root.
     *  \throw std::runtime_error as MotionSinceNode::feed(). */
    bool updateState(mrpt::obs::CActionCollection::Ptr action,
                     mrpt::obs::CSensoryFrame::Ptr observations,
                     mrpt::obs::CObservation::Ptr observation) override;

    /** When the robot was at each node, seconds since the UNIX epoch. */
    const std::map<mrpt::graphs::TNodeID, double>& getNodeTimestamps() const { return timestamps_; }

 protected:
    bool checkRegistrationCondition() override;

 private:
    bool feed(const mrpt::obs::CObservation::Ptr& observation);

    double registration_max_distance_ = 0.5;
    double registration_max_angle_ = 0;  ///< radians
    std::unique_ptr<MotionSinceNode> motion_;
    double root_timestamp_ = 0;
    std::map<mrpt::graphs::TNodeID, double> timestamps_;
};

extern template class COdometryNRD<mrpt::graphs::CNetworkOfPoses2DInf>;
extern template class COdometryNRD<mrpt::graphs::CNetworkOfPoses3DInf>;

}  // namespace fild
