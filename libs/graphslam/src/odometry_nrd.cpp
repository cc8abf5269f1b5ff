// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/odometry_nrd.h"

#include "constraint.h"
#include "fild/core/angle.h"
#include "fild/graphslam/decider_options.h"

#include <mrpt/config/CConfigFile.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr const char* kSection = "NodeRegistrationDeciderParameters";

double read_positive(const std::string& ini_path, const std::string& key, double preset)
{
    const mrpt::config::CConfigFile ini(ini_path);
    const double value = ini.read_double(kSection, key, preset, false);
    if (!(value > 0))
        throw std::runtime_error(ini_path + ": [" + kSection + "] " + key + "=" +
                                 ini.read_string(kSection, key, "") + " is not above 0");
    return value;
}

/** Angle of a rotation, [0, pi]. */
double angle_of(const mrpt::poses::CPose3D& pose)
{
    const auto& matrix = pose.getRotationMatrix();
    const double cosine = (matrix(0, 0) + matrix(1, 1) + matrix(2, 2) - 1) / 2;
    return std::acos(std::min(1.0, std::max(-1.0, cosine)));
}
}  // namespace

template <class GRAPH_T>
COdometryNRD<GRAPH_T>::COdometryNRD()
{
    this->setClassName("COdometryNRD");
}

template <class GRAPH_T>
void COdometryNRD<GRAPH_T>::loadParams(const std::string& source_fname)
{
    const auto options = load_decider_options(source_fname, kSection);
    this->setMinLoggingLevel(options.verbosity);
    registration_max_distance_ = read_positive(source_fname, "registration_max_distance", 0.5);
    registration_max_angle_ =
        read_positive(source_fname, "registration_max_angle", 15) * kRadiansPerDegree;
    motion_ = std::make_unique<MotionSinceNode>(options.graph);
}

template <class GRAPH_T>
void COdometryNRD<GRAPH_T>::printParams() const
{
    std::cout << "[" << kSection << "]\nregistration_max_distance = " << registration_max_distance_
              << "\nregistration_max_angle = " << registration_max_angle_ / kRadiansPerDegree
              << "\n";
}

template <class GRAPH_T>
void COdometryNRD<GRAPH_T>::getDescriptiveReport(std::string* report_str) const
{
    std::ostringstream text;
    text << "Node registration by odometry: every " << registration_max_distance_ << " m or "
         << registration_max_angle_ / kRadiansPerDegree << " degrees; " << timestamps_.size()
         << " nodes\n";
    *report_str += text.str();
}

template <class GRAPH_T>
bool COdometryNRD<GRAPH_T>::updateState(mrpt::obs::CActionCollection::Ptr action,
                                        mrpt::obs::CSensoryFrame::Ptr observations,
                                        mrpt::obs::CObservation::Ptr observation)
{
    if (!motion_) throw std::logic_error("COdometryNRD::updateState() before loadParams()");
    if (action) motion_->feed(*action);
    bool is_new = false;
    if (observations)
        for (const auto& each : *observations) is_new = feed(each) || is_new;
    if (observation) is_new = feed(observation) || is_new;
    return is_new && checkRegistrationCondition();
}

template <class GRAPH_T>
bool COdometryNRD<GRAPH_T>::feed(const mrpt::obs::CObservation::Ptr& observation)
{
    if (!motion_->feed(observation)) return false;
    const bool is_first = !motion_->motion() && timestamps_.empty();
    if (is_first) root_timestamp_ = motion_->timestamp();
    if (motion_->motion()) set_constraint(*motion_->motion(), this->m_since_prev_node_PDF);
    return motion_->motion().has_value();
}

template <class GRAPH_T>
bool COdometryNRD<GRAPH_T>::checkRegistrationCondition()
{
    const auto& moved = motion_->motion()->a_from_b;
    if (moved.norm() < registration_max_distance_ && angle_of(moved) < registration_max_angle_)
        return false;
    if (this->m_prev_registered_nodeID == mrpt::graphs::INVALID_NODEID)
    {
        const auto root = this->m_graph->root;
        this->m_graph->nodes[root] = typename parent_t::global_pose_t();
        this->m_prev_registered_nodeID = root;
        timestamps_[root] = root_timestamp_;
    }
    this->registerNewNodeAtEnd();
    timestamps_[this->m_prev_registered_nodeID] = motion_->timestamp();
    motion_->begin_at_node();
    return true;
}

template class COdometryNRD<mrpt::graphs::CNetworkOfPoses2DInf>;
template class COdometryNRD<mrpt::graphs::CNetworkOfPoses3DInf>;

}  // namespace fild
