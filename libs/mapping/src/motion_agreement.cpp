// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/motion_agreement.h"

#include "fild/core/angle.h"
#include "fild/core/spread.h"
#include "fild/rawlog/pose_conversion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace fild
{
namespace
{
constexpr double kLeastWay = 0.3;  // m
constexpr double kLeastTurn = 5 * kRadiansPerDegree;
constexpr std::size_t kEnough = 8;  // measurements

/** Two frames of one camera, and the robot's movement between them. */
struct FramePair
{
    const Place* earlier;
    const Place* later;
    RigidTransform earlier_from_later;  ///< of the robot
};

/** What one pair says. */
struct Comparison
{
    std::optional<double> direction_error_deg;
    std::optional<double> turned_direction_error_deg;
    std::optional<double> length_ratio;
};

double angle_between_deg(const cv::Vec3d& a, const cv::Vec3d& b)
{
    const double cosine = a.dot(b) / (cv::norm(a) * cv::norm(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadiansPerDegree;
}

/** Pose of a camera that looks ahead, on a robot. */
RigidTransform camera_axes()
{
    return {{0, 0, 1, -1, 0, 0, 0, -1, 0}, {}};
}

bool has_moved(const RigidTransform& motion)
{
    return cv::norm(motion.translation) >= kLeastWay ||
           cv::norm(vector_from_rotation(motion.rotation)) >= kLeastTurn;
}

/** Angle between what the images tell and the camera's movement: of its direction or of the axis of
 *  its turn, whichever is larger. Nothing when it neither moves nor turns. */
std::optional<double> direction_error(const RigidTransform& seen, const RigidTransform& expected)
{
    std::optional<double> error;  // std::optional compares less than any number when it is empty
    if (cv::norm(expected.translation) >= kLeastWay && cv::norm(seen.translation) > 0)
        error = angle_between_deg(seen.translation, expected.translation);
    const auto seen_turn = vector_from_rotation(seen.rotation);
    const auto expected_turn = vector_from_rotation(expected.rotation);
    if (cv::norm(seen_turn) >= kLeastTurn && cv::norm(expected_turn) >= kLeastTurn)
        error = std::max(error, std::optional(angle_between_deg(seen_turn, expected_turn)));
    return error;
}

RigidTransform camera_movement(const RigidTransform& robot, const RigidTransform& robot_from_camera)
{
    return robot_from_camera.inverse() * robot * robot_from_camera;
}

/** Accepts a pose however large its error is: where depths have a wrong scale, the error grows with
 *  them. */
TDetectorOptions of_any_scale(const TDetectorOptions& options)
{
    constexpr double kLargestAllowed = 1000;  // m
    auto changed = without_doubt(options);
    changed.relative_pose.max_position_deviation_m = kLargestAllowed;
    return changed;
}

/** Standard deviation of the length of a translation, m. */
double length_deviation(const UncertainTransform& pose)
{
    const auto& t = pose.b_from_a.translation;
    const double length = cv::norm(t);
    if (!(length > 0)) return 0;
    double variance = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            variance += t[row] * pose.covariance(row, column) * t[column];
    return std::sqrt(std::max(variance, 0.0)) / length;
}

/** Length of a movement by the images, divided by that of the trajectory; nothing when the robot
 *  stands still by both, or the images do not tell the length. */
std::optional<double> length_ratio(const UncertainTransform& seen, double expected_way)
{
    constexpr double kNoise = 0.01;  // m
    constexpr double kLargestDeviation = 0.25;  // of the length
    const double seen_way = cv::norm(seen.b_from_a.translation);
    const double way = std::max(seen_way, expected_way);
    if (way < kLeastWay || length_deviation(seen) > kLargestDeviation * way) return std::nullopt;
    return (seen_way + kNoise) / (expected_way + kNoise);
}

/** Nothing when the images tell no movement. */
std::optional<Comparison> compare(const FramePair& pair, const PairPoses& poses, StageTimes& times)
{
    const auto& earlier = *pair.earlier;
    const auto& later = *pair.later;
    const auto pose =
        poses.estimate(later, later.metric.depths, earlier, earlier.metric.depths, times);
    if (!pose.candidate_from_query && !pose.candidate_from_query_unscaled) return std::nullopt;
    const auto& seen = pose.candidate_from_query ? pose.candidate_from_query->b_from_a
                                                 : *pose.candidate_from_query_unscaled;
    const auto on_robot = earlier.metric.robot_from_camera.value_or(RigidTransform());
    const auto expected = camera_movement(pair.earlier_from_later, on_robot);
    Comparison comparison;
    comparison.direction_error_deg = direction_error(seen, expected);
    comparison.turned_direction_error_deg =
        direction_error(seen, camera_movement(pair.earlier_from_later, on_robot * camera_axes()));
    if (pose.candidate_from_query)
        comparison.length_ratio =
            length_ratio(*pose.candidate_from_query, cv::norm(expected.translation));
    return comparison;
}

/** A frame and one of those after it: the first with a movement, else one a little later, as
 *  the trajectory may miss a movement that there is. */
std::optional<FramePair> pair_from(std::size_t begin,
                                   const PlaceMap& places,
                                   const Trajectory& trajectory)
{
    constexpr std::size_t kReach = 10;
    constexpr std::size_t kWithoutMovement = 3;
    const auto& poses = trajectory.poses();
    const auto* earlier = places.find(poses[begin].frame);
    if (earlier == nullptr || !earlier->metric.camera) return std::nullopt;
    std::optional<FramePair> pair;
    const auto end = std::min(begin + 1 + kReach, poses.size());
    for (auto i = begin + 1; i < end && poses[i].segment == poses[begin].segment; ++i)
    {
        const auto* later = places.find(poses[i].frame);
        if (later == nullptr || !later->metric.camera ||
            later->sensor_label != earlier->sensor_label)
            continue;
        const auto motion = rigid_transform_from(poses[begin].map_from_robot).inverse() *
                            rigid_transform_from(poses[i].map_from_robot);
        const bool moved = has_moved(motion);
        if (moved || i <= begin + kWithoutMovement) pair = FramePair{earlier, later, motion};
        if (moved) break;
    }
    return pair;
}

Quartiles quartiles_of(std::vector<double> values)
{
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](std::size_t quarter) { return values[quarter * (values.size() - 1) / 4]; };
    return {values.size(), at(1), at(2), at(3)};
}

MotionAgreement summary_of(const std::vector<std::optional<Comparison>>& comparisons)
{
    std::vector<double> directions;
    std::vector<double> turned;
    std::vector<double> ratios;
    for (const auto& each : comparisons)
    {
        if (!each) continue;
        const auto& [error, turned_error, ratio] = *each;
        if (error) directions.push_back(*error);
        if (turned_error) turned.push_back(*turned_error);
        if (ratio) ratios.push_back(*ratio);
    }
    return {quartiles_of(directions), quartiles_of(turned), quartiles_of(ratios)};
}
}  // namespace

bool MotionAgreement::contradicts_directions() const
{
    constexpr double kWrong = 30;  // degrees
    constexpr double kLargestSpread = 45;  // between the quartiles: more is noise
    const auto& error = direction_error_deg;
    return error.count >= kEnough && error.lower > kWrong &&
           error.upper - error.lower < kLargestSpread;
}

bool MotionAgreement::lacks_turn() const
{
    constexpr double kRight = 20;  // degrees
    return contradicts_directions() && turned_direction_error_deg.upper < kRight;
}

bool MotionAgreement::contradicts_lengths() const
{
    constexpr double kWrong = 1.5;
    const auto& ratio = length_ratio;
    return ratio.count >= kEnough && (ratio.lower > kWrong || ratio.upper < 1 / kWrong);
}

MotionAgreement compare_motions(const PlaceMap& places,
                                const Trajectory& trajectory,
                                const TDetectorOptions& options,
                                StageTimes& times,
                                const CheckCancelled& check_cancelled)
{
    constexpr std::size_t kPairs = 50;
    const StageTimer timer(times, "motion_agreement");
    std::vector<FramePair> pairs;
    for (const auto i : spread_indices(kPairs, trajectory.poses().size()))
        if (const auto pair = pair_from(i, places, trajectory)) pairs.push_back(*pair);
    const PairPoses poses(of_any_scale(options));
    std::vector<std::optional<Comparison>> comparisons(pairs.size());
    timed_parallel_for(options.runtime.num_threads,
                       pairs.size(),
                       times,
                       check_cancelled,
                       [&](std::size_t i, StageTimes& own_times)
                       { comparisons[i] = compare(pairs[i], poses, own_times); });
    return summary_of(comparisons);
}

}  // namespace fild
