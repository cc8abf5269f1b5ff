// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/relative_pose.h"

#include "fild/core/angle.h"
#include "matched_pixels.h"
#include "pinhole.h"
#include "pose_refinement.h"
#include "two_view_motion.h"
#include "usac.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
void require_sound(const PoseView& view)
{
    const auto& depths = view.depths;
    const auto count = view.positions.size();
    if (depths.source != DepthSource::none &&
        (depths.metres.size() != count || depths.deviations_m.size() != count))
        throw std::invalid_argument(
            "RelativePoseEstimator: " + std::to_string(depths.metres.size()) + " depths of " +
            std::to_string(count) + " keypoints");
    if (view.camera && view.camera->lens != LensModel::none)
        throw std::invalid_argument("RelativePoseEstimator: a camera has a lens distortion");
}

MeasuredPoint measured_point(const PoseView& view, std::size_t keypoint)
{
    MeasuredPoint point{view.positions[keypoint]};
    if (view.depths.source == DepthSource::none) return point;
    const auto z = static_cast<double>(view.depths.metres[keypoint]);
    const auto deviation = static_cast<double>(view.depths.deviations_m[keypoint]);
    if (!(z > 0) || !std::isfinite(z) || !(deviation > 0) || !std::isfinite(deviation))
        return point;
    point.inverse_depth = 1 / z;
    point.inverse_depth_deviation = deviation / (z * z);
    return point;
}

/** Points in space of one frame and their pixels in the other. */
struct PointsAndPixels
{
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;

    void add(const MeasuredPoint& from, const CameraModel& from_camera, const MeasuredPoint& to)
    {
        if (!from.has_depth()) return;
        const cv::Vec3d point = (1 / from.inverse_depth) * ray_through(from_camera, from.pixel);
        points.emplace_back(point);
        pixels.emplace_back(to_vector(to.pixel));
    }
};

cv::UsacParams usac_parameters(const TRelativePoseOptions& options, int random_state)
{
    return magsac_parameters(
        {options.max_reprojection_px, options.confidence, options.max_iterations}, random_state);
}

/** The pose of the points' frame in the frame of the pixels' camera. */
std::optional<RigidTransform> ransac_pose(const PointsAndPixels& seen,
                                          const CameraModel& camera,
                                          const cv::UsacParams& usac)
{
    constexpr std::size_t kFewest = 4;
    if (seen.points.size() < kFewest) return std::nullopt;
    cv::Mat intrinsics(camera_matrix(camera));
    cv::Mat rotation_vector;
    cv::Mat translation;
    const cv::Mat no_distortion;
    std::vector<int> inliers;
    const bool found = cv::solvePnPRansac(seen.points,
                                          seen.pixels,
                                          intrinsics,
                                          no_distortion,
                                          rotation_vector,
                                          translation,
                                          inliers,
                                          usac);
    if (!found || rotation_vector.total() != 3 || translation.total() != 3 ||
        !cv::checkRange(rotation_vector) || !cv::checkRange(translation))
        return std::nullopt;
    return RigidTransform{rotation_from_vector(cv::Vec3d(rotation_vector)), cv::Vec3d(translation)};
}

/** Both ways' hypothesis with which more matches agree. */
std::optional<RigidTransform> best_hypothesis(const std::vector<MeasuredMatch>& matches,
                                              const PinholePair& cameras,
                                              const cv::UsacParams& usac)
{
    PointsAndPixels candidate_points;
    PointsAndPixels query_points;
    for (const auto& match : matches)
    {
        candidate_points.add(match.candidate, cameras.candidate, match.query);
        query_points.add(match.query, cameras.query, match.candidate);
    }
    auto best = ransac_pose(query_points, cameras.candidate, usac);
    const auto query_from_candidate = ransac_pose(candidate_points, cameras.query, usac);
    if (!query_from_candidate) return best;
    const auto other = query_from_candidate->inverse();
    const MeasuredNoise noise{usac.threshold / 3, 1};
    if (!best || agreeing(matches, cameras, other, noise).size() >
                     agreeing(matches, cameras, *best, noise).size())
        best = other;
    return best;
}

/** The odometry's scale moves both frames' points alike: an error along the translation. */
void add_scale_error(UncertainTransform& pose, double scale_deviation)
{
    const auto& t = pose.b_from_a.translation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            pose.covariance(row, column) += scale_deviation * scale_deviation * t[row] * t[column];
}

/** True when no axis is known worse than asked for. */
bool is_certain(const cv::Matx66d& covariance, const TRelativePoseOptions& options)
{
    const auto worst = [&](int first)
    {
        cv::Matx33d block;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                block(row, column) = covariance(first + row, first + column);
        cv::Vec3d eigenvalues;
        cv::eigen(block, eigenvalues);
        return std::sqrt(eigenvalues[0]);
    };
    return worst(0) <= options.max_position_deviation_m &&
           worst(3) <= options.max_rotation_deviation_deg * kRadiansPerDegree;
}

/** Standard deviation of pixels across the line that fits them best: of points on a line nothing
 *  tells how the camera is turned about it, and noise may pass for an answer. */
double spread_across(const std::vector<MeasuredMatch>& matches,
                     const std::vector<std::size_t>& which)
{
    cv::Vec2d sum;
    cv::Matx22d squares = cv::Matx22d::zeros();
    for (const auto k : which)
    {
        const auto pixel = to_vector(matches[k].query.pixel);
        sum += pixel;
        squares += pixel * pixel.t();
    }
    const double share = 1 / static_cast<double>(which.size());
    const cv::Matx22d covariance = share * squares - (share * sum) * (share * sum).t();
    cv::Vec2d eigenvalues;
    cv::eigen(covariance, eigenvalues);
    return std::sqrt(std::max(eigenvalues[1], 0.0));
}

/** Why a pose is not to be trusted. */
NoMetricPose weakness_of(const RefinedPose& pose,
                         const std::vector<MeasuredMatch>& matches,
                         const TRelativePoseOptions& options)
{
    constexpr double kNarrowestPx = 5;
    const auto inliers = pose.inliers.size();
    if (inliers < static_cast<std::size_t>(options.min_points)) return NoMetricPose::too_few_points;
    if (static_cast<double>(inliers) <
        options.min_inlier_share * static_cast<double>(matches.size()))
        return NoMetricPose::disagreement;
    if (spread_across(matches, pose.inliers) < kNarrowestPx ||
        !is_certain(pose.candidate_from_query.covariance, options))
        return NoMetricPose::degenerate;
    return NoMetricPose::none;
}

/** Matches with a depth in either frame. */
struct MatchesWithDepth
{
    std::vector<MeasuredMatch> matches;
    std::vector<std::size_t> index_of;  ///< among all matches
};

MatchesWithDepth with_depth(const PoseView& query,
                            const PoseView& candidate,
                            const std::vector<Match>& matches)
{
    MatchesWithDepth result;
    for (std::size_t k = 0; k < matches.size(); ++k)
    {
        const MeasuredMatch match{measured_point(query, matches[k].query),
                                  measured_point(candidate, matches[k].candidate)};
        if (!match.query.has_depth() && !match.candidate.has_depth()) continue;
        result.matches.push_back(match);
        result.index_of.push_back(k);
    }
    return result;
}

RelativePose without_pose(NoMetricPose reason)
{
    RelativePose result;
    result.reason = reason;
    return result;
}

RelativePose without_scale(const PoseView& query,
                           const PoseView& candidate,
                           const std::vector<Match>& matches,
                           double max_error_px,
                           int random_state)
{
    auto result = without_pose(NoMetricPose::no_depth);
    auto motion = two_view_motion({*query.camera,
                                   query_pixels(matches, query.positions),
                                   *candidate.camera,
                                   candidate_pixels(matches, candidate.positions)},
                                  max_error_px,
                                  random_state);
    if (!motion) return result;
    result.candidate_from_query_unscaled = motion->b_from_a;
    result.inliers = std::move(motion->inliers);
    return result;
}
}  // namespace

std::string to_word(NoMetricPose reason)
{
    switch (reason)
    {
        case NoMetricPose::none:
            return "";
        case NoMetricPose::not_calibrated:
            return "not_calibrated";
        case NoMetricPose::no_depth:
            return "no_depth";
        case NoMetricPose::too_few_points:
            return "too_few_points";
        case NoMetricPose::no_model:
            return "no_model";
        case NoMetricPose::degenerate:
            return "degenerate";
        case NoMetricPose::disagreement:
            return "disagreement";
    }
    return "";
}

RelativePoseEstimator::RelativePoseEstimator(const TRelativePoseOptions& options,
                                             std::uint64_t seed)
    : options_(options), random_state_(usac_random_state(seed))
{
    options_.check();
}

RelativePose RelativePoseEstimator::estimate(const PoseView& query,
                                             const PoseView& candidate,
                                             const std::vector<Match>& matches) const
{
    require_sound(query);
    require_sound(candidate);
    query_pixels(matches, query.positions);  // throws on a bad index
    candidate_pixels(matches, candidate.positions);
    if (!query.camera || !candidate.camera) return without_pose(NoMetricPose::not_calibrated);
    const auto measured = with_depth(query, candidate, matches);
    if (measured.matches.empty())
        return without_scale(
            query, candidate, matches, options_.max_reprojection_px, random_state_);

    auto result = without_pose(NoMetricPose::no_model);
    result.with_depth = measured.matches.size();
    result.source = candidate.depths.source != DepthSource::none ? candidate.depths.source
                                                                 : query.depths.source;
    if (result.with_depth < static_cast<std::size_t>(options_.min_points))
    {
        result.reason = NoMetricPose::too_few_points;
        return result;
    }
    const PinholePair cameras{*query.camera, *candidate.camera};
    const auto start =
        best_hypothesis(measured.matches, cameras, usac_parameters(options_, random_state_));
    if (!start) return result;
    auto refined = refined_pose(measured.matches, cameras, *start);
    result.reason = NoMetricPose::degenerate;
    if (!refined) return result;
    for (const auto k : refined->inliers) result.inliers.push_back(measured.index_of[k]);
    result.inlier_share =
        static_cast<double>(result.inliers.size()) / static_cast<double>(measured.matches.size());
    result.pixel_deviation_px = refined->noise.pixel_deviation_px;
    result.depth_deviation_factor = refined->noise.depth_factor;
    add_scale_error(refined->candidate_from_query,
                    std::max(query.depths.scale_deviation, candidate.depths.scale_deviation));
    result.reason = weakness_of(*refined, measured.matches, options_);
    if (result.reason == NoMetricPose::none)
        result.candidate_from_query = refined->candidate_from_query;
    return result;
}

}  // namespace fild
