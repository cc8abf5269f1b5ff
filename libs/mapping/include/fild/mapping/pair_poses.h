// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"
#include "fild/core/stage_times.h"
#include "fild/detector/pair_verifier.h"
#include "fild/geometry/relative_pose.h"
#include "fild/places/place_map.h"

#include <functional>
#include <vector>

namespace fild
{
/** Metric poses between any two places: they are matched, verified and
 *  solved as a loop closure is. Const members may run concurrently, each with its own StageTimes.
 */
class PairPoses
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit PairPoses(const TDetectorOptions& options);

    /** \param query_depths,candidate_depths  of the places' keypoints.
     *  \param times receives "matching", "verification" and "relative_pose".
     *  \return reason too_few_points when the pair is not verified. */
    RelativePose estimate(const Place& query,
                          const KeypointDepths& query_depths,
                          const Place& candidate,
                          const KeypointDepths& candidate_depths,
                          StageTimes& times) const;

 private:
    PairVerifier pairs_;
    RelativePoseEstimator poses_;
};

/** The options for pairs of frames that are known to show one place, as those taken one after the
 *  other: their matches need not prove it, so that as few inliers as a pose takes will do, and
 *  half the share of them that is asked of a loop. */
TDetectorOptions without_doubt(const TDetectorOptions& options);

/** parallel_for() whose bodies time their stages: the times are added up in the order of i.
 *  \param check_cancelled  called before each body. */
void timed_parallel_for(int num_threads,
                        std::size_t count,
                        StageTimes& times,
                        const CheckCancelled& check_cancelled,
                        const std::function<void(std::size_t, StageTimes&)>& body);

}  // namespace fild
