// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graphslam/node_loops.h"

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/interfaces/CEdgeRegistrationDecider.h>

#include <map>
#include <memory>
#include <string>

namespace fild
{
/** Edge registration decider for mrpt::graphslam::CGraphSlamEngine: visual loop closures, in 2D and
 *  3D. An adapter of NodeLoops, which says what an edge is made of.
 *
 *  A loop's edge goes from the node nearest in time to the earlier frame to the node nearest to the
 *  later one; it is registered when the node after the later frame is, and finish() registers those
 *  that no node came after. The root, whose time a decider does not learn, gets no loop: the first
 *  frames go to the node after it. In 2D an edge is the marginal of x, y and yaw.
 *
 *  - Map type: 2D, 3D
 *  - MRPT rawlog format: #1 (actions and sensory frames), #2 (observations)
 *  - Graph type: CPosePDFGaussianInf, CPose3DPDFGaussianInf
 *  - Observations: CObservationStereoImages, CObservation3DRangeScan with an image, both with their
 *    calibration (a single camera has no scale: its loops are counted, and make no edge);
 *    odometry as COdometryNRD, for the way between a node and a frame at another time
 *  - Any node registration decider whose nodes stand where the robot was at the entry of the rawlog
 *    that brought them: COdometryNRD, MRPT's CFixedIntervalsNRD, CICPCriteriaNRD
 *
 *  Keys of section EdgeRegistrationDeciderParameters of the engine's .ini file:
 *
 *  | key | default | meaning |
 *  |---|---|---|
 *  | `class_verbosity` | 1 | 0 debug, 1 info (each loop a line), 2 warnings, 3 errors |
 *  | `fild_config` | required | configuration of mrpt-fild: how loops are found ([input] to
 *    [relative_pose]), how certain the odometry is ([graph]); relative to the engine's .ini file |
 *
 *  For CNetworkOfPoses2DInf and CNetworkOfPoses3DInf. Deterministic. Not thread-safe: one caller
 *  at a time, as CGraphSlamEngine is. */
template <class GRAPH_T>
class CVisualLoopERD : public mrpt::graphslam::deciders::CEdgeRegistrationDecider<GRAPH_T>
{
 public:
    using parent_t = mrpt::graphslam::deciders::CEdgeRegistrationDecider<GRAPH_T>;
    using constraint_t = typename GRAPH_T::constraint_t;

    /** \param rawlog_path  where the observations come from, when there is one: images stored
     *         outside are looked for beside it. */
    explicit CVisualLoopERD(const std::string& rawlog_path = "");

    /** \throw std::runtime_error as load_decider_options() and NodeLoops. */
    void loadParams(const std::string& source_fname) override;
    void printParams() const override;
    void getDescriptiveReport(std::string* report_str) const override;

    /** `lc`: the loop closures. */
    void getEdgesStats(std::map<std::string, int>* edge_type_to_num) const override;

    /** \return true. \throw std::runtime_error as LoopClosureStream::feed(). */
    bool updateState(mrpt::obs::CActionCollection::Ptr action,
                     mrpt::obs::CSensoryFrame::Ptr observations,
                     mrpt::obs::CObservation::Ptr observation) override;

    /** To be called after the last entry: registers the loops of the frames after the last node. */
    void finish();

    std::size_t numRegisteredLoops() const { return registered_; }
    /** \pre loadParams() was called. */
    const NodeLoopReport& report() const { return loops_->report(); }

 protected:
    void registerNewEdge(const mrpt::graphs::TNodeID& from,
                         const mrpt::graphs::TNodeID& to,
                         const constraint_t& rel_edge) override;

 private:
    void note_new_node(const mrpt::obs::CSensoryFrame::Ptr& observations,
                       const mrpt::obs::CObservation::Ptr& observation);
    void add_edges(const std::vector<NodeLoop>& loops);

    std::string rawlog_path_;
    std::unique_ptr<NodeLoops> loops_;
    std::size_t known_nodes_ = 0;
    std::size_t registered_ = 0;
};

extern template class CVisualLoopERD<mrpt::graphs::CNetworkOfPoses2DInf>;
extern template class CVisualLoopERD<mrpt::graphs::CNetworkOfPoses3DInf>;

}  // namespace fild
