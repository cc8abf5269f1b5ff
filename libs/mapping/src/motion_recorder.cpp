// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/motion_recorder.h"

#include "fild/mapping/trajectory_builder.h"
#include "gps_recorder.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

namespace fild
{
struct MotionRecorder::State
{
    explicit State(const TGraphOptions& checked_options)
        : options(checked_options), odometry(checked_options), gps(checked_options)
    {
    }

    TGraphOptions options;
    TrajectoryBuilder odometry;
    GpsRecorder gps;
};

MotionRecorder::MotionRecorder(const TGraphOptions& options)
{
    options.check();
    state_ = std::make_unique<State>(options);
}

MotionRecorder::~MotionRecorder() = default;

void MotionRecorder::feed(const mrpt::obs::CObservation& observation)
{
    state_->odometry.feed(observation);
    state_->gps.feed(observation);
}

void MotionRecorder::feed(const mrpt::obs::CActionCollection& actions)
{
    state_->odometry.feed(actions);
}

void MotionRecorder::add_frame(FrameId frame, double timestamp)
{
    state_->odometry.add_frame(frame, timestamp);
    state_->gps.add_frame(frame, timestamp);
}

Trajectory MotionRecorder::odometry() const
{
    return state_->odometry.build();
}

GpsRecord MotionRecorder::gps() const
{
    return state_->gps.build();
}

Trajectory MotionRecorder::gps_alone() const
{
    const auto record = gps();
    if (record.tracks.empty()) return {{}, {}};
    return trajectory_of(record.tracks.front(), state_->options);
}

}  // namespace fild
