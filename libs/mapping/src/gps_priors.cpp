// SPDX-License-Identifier: BSD-3-Clause
#include "gps_priors.h"

#include "fild/core/upper_median.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace fild
{
namespace
{
using Eigen::Vector3d;

/** A position of a track near a frame. */
struct NearPosition
{
    std::size_t index = 0;
    double seconds = 0;  ///< after the frame
    std::size_t from_arrival = 0;  ///< how many positions it came from the frame's place
};

/** Of the position nearest in time in each run that whose place in the recording is nearest. */
std::optional<NearPosition> near_position(const GpsTrack& track,
                                          const AwaitedFrame& frame,
                                          double max_seconds)
{
    std::optional<NearPosition> best;
    const auto consider = [&](std::size_t i)
    {
        const double seconds = track.positions[i].seconds - frame.timestamp;
        const auto away = i > frame.arrival ? i - frame.arrival : frame.arrival - i;
        if (std::abs(seconds) > max_seconds) return;
        const bool is_same_run = best && std::max(best->index, i) - std::min(best->index, i) == 1;
        const bool is_better = !best || (is_same_run ? std::abs(seconds) < std::abs(best->seconds)
                                                     : away < best->from_arrival);
        if (is_better) best = NearPosition{i, seconds, away};
    };
    for (const auto& run : track.runs)
    {
        const auto begin = track.positions.begin() + static_cast<std::ptrdiff_t>(run.begin);
        const auto end = track.positions.begin() + static_cast<std::ptrdiff_t>(run.end);
        const auto after = std::lower_bound(begin,
                                            end,
                                            frame.timestamp,
                                            [](const GpsPosition& position, double seconds)
                                            { return position.seconds < seconds; });
        if (after != begin) consider(static_cast<std::size_t>(after - track.positions.begin()) - 1);
        if (after != end) consider(static_cast<std::size_t>(after - track.positions.begin()));
    }
    return best;
}

std::optional<std::size_t> next_in_segment(const std::vector<Trajectory::Frame>& frames,
                                           std::size_t i,
                                           bool later)
{
    if (later ? i + 1 >= frames.size() : i == 0) return std::nullopt;
    const auto next = later ? i + 1 : i - 1;
    if (frames[next].at.segment != frames[i].at.segment) return std::nullopt;
    return next;
}

/** The robot's movement in `seconds` after a frame, in its axes there; nothing when the motion does
 *  not tell. */
std::optional<Rigid> movement_after(const Trajectory& motion, std::size_t frame, double seconds)
{
    constexpr double kSameMoment = 0.01;  // s
    constexpr double kFurthest = 1.5;  // of the time between the two frames next to the moment
    if (std::abs(seconds) < kSameMoment) return Rigid();
    const auto& frames = motion.frames();
    const auto away = [&](std::size_t i)
    { return std::abs(frames[i].timestamp - frames[frame].timestamp); };
    auto before = frame;
    auto after = next_in_segment(frames, before, seconds > 0);
    while (after && away(*after) < std::abs(seconds))
    {
        const auto next = next_in_segment(frames, *after, seconds > 0);
        if (!next) break;
        before = *after;
        after = next;
    }
    if (!after) return std::nullopt;
    const double share = (std::abs(seconds) - away(before)) / (away(*after) - away(before));
    if (!(share >= 0 && share <= kFurthest)) return std::nullopt;
    return frames[frame].at.map_from_robot.inverse() *
           between(frames[before].at.map_from_robot, frames[*after].at.map_from_robot, share);
}

Vector3d to_vector(const mrpt::math::TPoint3D& point)
{
    return {point.x, point.y, point.z};
}

mrpt::math::TPoint3D to_point(const Vector3d& vector)
{
    return {vector.x(), vector.y(), vector.z()};
}

mrpt::math::CMatrixDouble33 information_of(double sigma, double variance_scale)
{
    const double horizontal = 1 / (sigma * sigma * variance_scale);
    mrpt::math::CMatrixDouble33 information;
    information.setZero();
    information(0, 0) = information(1, 1) = horizontal;
    information(2, 2) = horizontal / (kVerticalOfHorizontal * kVerticalOfHorizontal);
    return information;
}

std::optional<std::size_t> index_of(const Trajectory& motion, FrameId frame)
{
    const auto& frames = motion.frames();
    const auto found =
        std::lower_bound(frames.begin(),
                         frames.end(),
                         frame,
                         [](const Trajectory::Frame& each, FrameId id) { return each.id < id; });
    if (found == frames.end() || found->id != frame) return std::nullopt;
    return static_cast<std::size_t>(found - frames.begin());
}

/** A point by the motion, where it is in the map, and how much it counts. */
struct PointPair
{
    Vector3d by_motion;
    Vector3d in_map;
    double weight = 1;
};

/** The rigid transform that takes the points to the map with the least weighted squares. */
Rigid fit(const std::vector<PointPair>& pairs, bool about_vertical)
{
    Vector3d centre = Vector3d::Zero();
    Vector3d map_centre = Vector3d::Zero();
    double sum = 0;
    for (const auto& pair : pairs)
    {
        centre += pair.weight * pair.by_motion;
        map_centre += pair.weight * pair.in_map;
        sum += pair.weight;
    }
    centre /= sum;
    map_centre /= sum;
    Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
    for (const auto& pair : pairs)
        product += pair.weight * (pair.in_map - map_centre) * (pair.by_motion - centre).transpose();
    Rigid result;
    if (about_vertical)
        result.rotation = Eigen::AngleAxisd(std::atan2(product(1, 0) - product(0, 1),
                                                       product(0, 0) + product(1, 1)),
                                            Vector3d::UnitZ())
                              .toRotationMatrix();
    else
    {
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product,
                                                    Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
        const Vector3d signs(1, 1, turn.determinant() < 0 ? -1 : 1);
        result.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    }
    result.translation = map_centre - result.rotation * centre;
    return result;
}

double distance(const Rigid& map_from_motion, const PointPair& pair)
{
    return (map_from_motion.rotation * pair.by_motion + map_from_motion.translation - pair.in_map)
        .norm();
}

/** As fit(), least distances instead of squares: far points count little. */
Rigid robust_fit(std::vector<PointPair> pairs, bool about_vertical)
{
    constexpr int kRounds = 20;
    constexpr double kNear = 0.1;  // m: nearer ones count alike
    auto best = fit(pairs, about_vertical);
    std::vector<double> weights;
    weights.reserve(pairs.size());
    for (const auto& pair : pairs) weights.push_back(pair.weight);
    for (int round = 0; round < kRounds; ++round)
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            pairs[i].weight = std::sqrt(weights[i]) / std::max(kNear, distance(best, pairs[i]));
        best = fit(pairs, about_vertical);
    }
    return best;
}

double median_distance(const Rigid& map_from_motion, const std::vector<PointPair>& pairs)
{
    std::vector<double> distances;
    distances.reserve(pairs.size());
    for (const auto& pair : pairs) distances.push_back(distance(map_from_motion, pair));
    return upper_median(std::move(distances));
}

/** True when the map's vertical is that of a robot (z up) or a camera (y down): positions that are
 *  mirrored fit a robot that drives on its roof. */
bool is_plausible(const Rigid& map_from_motion)
{
    constexpr double kCosine = 0.7;
    const Vector3d up = map_from_motion.rotation.transpose() * Vector3d::UnitZ();
    return up.z() > kCosine || -up.y() > kCosine;
}

Rigid map_from_motion(const std::vector<PointPair>& pairs)
{
    constexpr double kMuchBetter = 3;
    const auto upright = robust_fit(pairs, true);
    const auto tilted = robust_fit(pairs, false);
    const bool is_tilted =
        pairs.size() > 3 && is_plausible(tilted) &&
        median_distance(upright, pairs) > kMuchBetter * median_distance(tilted, pairs);
    return is_tilted ? tilted : upright;
}
}  // namespace

std::vector<GraphPrior> priors_of(const GpsTrack& track,
                                  const Trajectory& motion,
                                  const std::set<FrameId>& keyframes,
                                  double max_gap_s,
                                  double variance_scale)
{
    std::map<std::size_t, std::pair<double, GraphPrior>> by_position;
    for (const auto& frame : track.frames)
    {
        if (keyframes.count(frame.id) == 0) continue;
        const auto near = near_position(track, frame, max_gap_s / 2);
        const auto index = index_of(motion, frame.id);
        if (!near || !index) continue;
        const auto moved = movement_after(motion, *index, near->seconds);
        if (!moved) continue;
        const auto& position = track.positions[near->index];
        const Vector3d antenna = moved->rotation * position.robot_from_antenna + moved->translation;
        const GraphPrior prior{frame.id,
                               to_point(position.map_from_antenna),
                               to_point(antenna),
                               information_of(position.sigma_m, variance_scale)};
        const auto known = by_position.find(near->index);
        if (known == by_position.end() || std::abs(near->seconds) < known->second.first)
            by_position[near->index] = {std::abs(near->seconds), prior};
    }
    std::vector<GraphPrior> priors;
    priors.reserve(by_position.size());
    for (const auto& [position, prior] : by_position) priors.push_back(prior.second);
    return priors;
}

Trajectory placed_by(const std::vector<GraphPrior>& priors, const Trajectory& motion)
{
    std::map<int, std::vector<PointPair>> pairs;  // by segment
    for (const auto& prior : priors)
    {
        const auto& at = motion.frames()[*index_of(motion, prior.frame)].at;
        pairs[at.segment].push_back(
            {at.map_from_robot.rotation * to_vector(prior.robot_from_point) +
                 at.map_from_robot.translation,
             to_vector(prior.map_from_point),
             prior.information(0, 0)});
    }
    std::optional<Rigid> last;
    auto poses = motion.poses();
    std::map<int, Rigid> of_segment;
    for (auto& [segment, points] : pairs) of_segment[segment] = map_from_motion(points);
    for (auto& pose : poses)
    {
        const auto found = of_segment.find(pose.segment);
        if (found != of_segment.end()) last = found->second;
        if (!last) last = of_segment.empty() ? Rigid() : of_segment.begin()->second;
        pose.map_from_robot = to_pose(*last * to_rigid(pose.map_from_robot));
    }
    return with_poses(motion, poses);
}

}  // namespace fild
