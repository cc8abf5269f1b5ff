// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/motion_since_node.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <stdexcept>

namespace fild
{
MotionSinceNode::MotionSinceNode(const TGraphOptions& options)
    : options_(options), builder_(std::make_unique<TrajectoryBuilder>(options))
{
    if (!options.sources().odometry)
        throw std::invalid_argument(
            "[graph] motion_sources=" + options.motion_sources +
            ": an engine takes its motion from odometry; rawlog-loop-closure takes the others");
}

void MotionSinceNode::feed(const mrpt::obs::CActionCollection& actions)
{
    builder_->feed(actions);
}

bool MotionSinceNode::feed(const std::shared_ptr<mrpt::obs::CObservation>& observation)
{
    builder_->feed(*observation);
    const auto readings = builder_->readings();
    if (readings == readings_) return false;
    readings_ = readings;
    last_reading_ = observation;
    timestamp_ = mrpt::Clock::toDouble(observation->timestamp);
    if (readings == 1) return true;
    motion_ = builder_->motion_so_far();
    if (!motion_)
        throw std::runtime_error(
            "the odometry was reset or jumped at " + std::to_string(timestamp_) +
            " s, and the graph of an engine must hold together; rawlog-loop-closure makes maps of "
            "such recordings");
    return true;
}

void MotionSinceNode::begin_at_node()
{
    builder_ = std::make_unique<TrajectoryBuilder>(options_);
    builder_->feed(*last_reading_);
    readings_ = builder_->readings();  // none, where motions come from actions
    motion_.reset();
}

}  // namespace fild
