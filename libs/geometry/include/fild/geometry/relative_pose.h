// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/keypoint_depths.h"
#include "fild/core/rigid_transform.h"
#include "fild/geometry/relative_pose_options.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Why two frames have no metric relative pose. */
enum class NoMetricPose
{
    none,  ///< they have one
    not_calibrated,  ///< one of the cameras
    no_depth,  ///< no match has a depth in either frame: scale is unknown
    too_few_points,  ///< fewer matches with depth, or fewer of them agree, than
    ///< TRelativePoseOptions::min_points
    no_model,  ///< RANSAC found no pose
    degenerate,  ///< the points do not fix all six degrees of freedom well enough
    disagreement  ///< too small a share of the verified matches agrees with the pose
};

/** The enumerator's name; empty for NoMetricPose::none. */
std::string to_word(NoMetricPose reason);

/** One of the two frames: what the map keeps of it. Refers to its arguments. */
struct PoseView
{
    const std::optional<CameraModel>& camera;  ///< a pinhole
    const std::vector<PixelPosition>& positions;
    const KeypointDepths& depths;  ///< of `positions`, or none
};

/** Outcome of RelativePoseEstimator. Value type. */
struct RelativePose
{
    NoMetricPose reason = NoMetricPose::none;  ///< why candidate_from_query is empty
    /** Pose of the query's camera in the candidate camera's frame, metres, with its covariance;
     *  order and meaning of the six errors: UncertainTransform. */
    std::optional<UncertainTransform> candidate_from_query;
    /** Without any depth: rotation, and the direction of the translation as a unit vector, from the
     *  essential matrix. It has no scale; a graph must not take it for a metric pose. */
    std::optional<RigidTransform> candidate_from_query_unscaled;
    /** Matches that agree with the pose (or with the essential matrix), ascending, as indices into
     *  what the caller gave. */
    std::vector<std::size_t> inliers;
    std::size_t with_depth = 0;  ///< matches that could take part
    double inlier_share =
        0;  ///< inliers / with_depth: those of the fundamental matrix that are metric
    double pixel_deviation_px = 0;  ///< of a keypoint in each direction, as measured
    /** Measured by declared standard deviation of the depths; 1 where it cannot be measured, with
     *  fewer than 20 inliers known in both frames. */
    double depth_deviation_factor = 1;
    DepthSource source = DepthSource::none;  ///< candidate's, else the query's
};

/** The metric pose of a query relative to a candidate, from verified matches and depths.
 *
 *  RANSAC with three points at a time (OpenCV's USAC, P3P, MAGSAC++) on the candidate's points and
 *  the query's pixels, and the other way round; the hypothesis with more agreeing matches is
 * refined by Gauss-Newton on all matches. A match is weighed by the whole of its noise, pixels and
 * depths of both frames, propagated through the pose: with the depth in one frame it gives two
 * equations, with depths in both three. Nothing is counted
 *  twice. Cauchy's loss lessens the doubtful ones. Noise of pixels and depths is measured from the
 *  residuals by medians; the covariance is the inverse of the information, times a variance factor
 *  that is measured from the residuals too, neighbouring matches taken as one. Deterministic. Const
 * members may run concurrently. */
class RelativePoseEstimator
{
 public:
    /** \param seed of RANSAC. \throw std::invalid_argument on bad options. */
    RelativePoseEstimator(const TRelativePoseOptions& options, std::uint64_t seed);

    /** \param matches  that agree with one fundamental matrix, between query.positions and
     *         candidate.positions. Costs some milliseconds for some hundred.
     *  \throw std::invalid_argument when an index of a match is beyond the positions, depths are
     *         not as many as positions, or a camera has a lens distortion. */
    RelativePose estimate(const PoseView& query,
                          const PoseView& candidate,
                          const std::vector<Match>& matches) const;

 private:
    TRelativePoseOptions options_;
    int random_state_;
};

}  // namespace fild
