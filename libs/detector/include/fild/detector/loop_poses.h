// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/geometry/relative_pose.h"
#include "fild/places/place_map.h"

#include <optional>

namespace fild
{
/** Metric poses of accepted loops, as far as the recording has depth. Const members may run
 *  concurrently, each with its own StageTimes. */
class LoopPoses
{
 public:
    /** With [relative_pose] not enabled there are none.
     *  \throw std::invalid_argument on bad options. */
    explicit LoopPoses(const TDetectorOptions& options);

    /** Sets the pose of an accepted loop between two of the places.
     *  \param times  receives "relative_pose". */
    void add_pose(DetectorOutcome& outcome, const PlaceMap& places, StageTimes& times) const;

 private:
    std::optional<RelativePoseEstimator> poses_;
};

}  // namespace fild
