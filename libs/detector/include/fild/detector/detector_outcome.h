// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/keypoint_depths.h"
#include "fild/core/verdict.h"
#include "fild/geometry/relative_pose.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The detector's answer for one frame, with what a picture or a constraint is made of. */
struct DetectorOutcome
{
    FrameVerdict verdict;
    std::vector<PixelPair> matches;  ///< with verdict.candidate, after the ratio test
    std::vector<std::size_t> inliers;  ///< indices into `matches`
    /** The nearest answers of the index, ten (or ef) if there are, most similar first, then the
     *  other frames that were verified, in that order. */
    std::vector<ConsideredCandidate> considered;
    /** Of each of `matches`, which keypoints they are. */
    std::vector<Match> keypoint_matches{};
    DepthSource depth_source = DepthSource::none;  ///< of this frame's own depths
    /** Of an accepted loop: the metric pose of query from candidate, or why there is none. Nothing
     *  when [relative_pose] is not enabled. */
    std::optional<RelativePose> pose{};
    GlobalDescriptor global{};  ///< of this frame; empty for one that could not be used
};

}  // namespace fild
