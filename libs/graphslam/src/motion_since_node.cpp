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
}

void MotionSinceNode::feed(const mrpt::obs::CActionCollection& actions)
{
    builder_->feed(actions);
}

bool MotionSinceNode::feed(const std::shared_ptr<mrpt::obs::CObservation>& observation)
{
    builder_->feed(*observation);
    const auto readings = builder_->build().report().readings;
    if (readings == readings_) return false;
    readings_ = readings;
    last_reading_ = observation;
    timestamp_ = mrpt::Clock::toDouble(observation->timestamp);
    builder_->add_frame(FrameId{moments_++}, timestamp_);
    if (moments_ == 1) return true;
    motion_ = builder_->build().motion(FrameId{0}, FrameId{moments_ - 1});
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
    readings_ = builder_->build().report().readings;  // none, where motions come from actions
    builder_->add_frame(FrameId{0}, timestamp_);
    moments_ = 1;
    motion_.reset();
}

}  // namespace fild
