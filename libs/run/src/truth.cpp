// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/truth.h"

#include "fild/rawlog/recorded_path.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
TimedPose to_timed_pose(const StampedPose& stamped)
{
    TimedPose timed;
    timed.timestamp = stamped.seconds;
    timed.pose.position = {stamped.x, stamped.y, stamped.z};
    timed.pose.rotation = rotation_of({stamped.qx, stamped.qy, stamped.qz, stamped.qw});
    return timed;
}

TruePoses poses_in_rawlog(const std::string& path,
                          const std::string& sensor,
                          const std::vector<FrameVerdict>& frames)
{
    const auto recorded = read_recorded_path(path, sensor);
    const bool gps = recorded.source == RecordedPath::Source::gps;
    MeasuredPath measured;
    measured.oriented = !gps;
    measured.poses.reserve(recorded.poses.size());
    for (const auto& pose : recorded.poses) measured.poses.push_back(to_timed_pose(pose));
    const auto content =
        std::string(gps ? "GPS" : "robot poses") + " '" + recorded.sensor_label + "'";
    return true_poses_along(measured, content, frames);
}
}  // namespace

bool is_rawlog(const std::string& file)
{
    const std::filesystem::path name(file);
    return name.extension() == ".rawlog" ||
           (name.extension() == ".gz" && name.stem().extension() == ".rawlog");
}

Protocol protocol_for(const std::string& file, const std::string& word)
{
    constexpr const char* kForPoses = "radius:5";
    const auto asked = word.empty() ? std::optional<Protocol>() : parse_protocol(word);
    const bool with_poses = is_rawlog(file) || holds_poses(file);
    if (!asked) return parse_protocol(with_poses ? kForPoses : "exact");
    const bool by_radius = asked->kind == Protocol::Kind::radius;
    if (with_poses && !by_radius)
        throw std::invalid_argument(file + " holds poses, not labels: --protocol must be radius:R");
    if (!with_poses && by_radius)
        throw std::invalid_argument(file +
                                    " holds labels, not poses: --protocol must be exact or "
                                    "window:N");
    return *asked;
}

TruthOptions for_run(TruthOptions options, std::optional<double> delay_seconds)
{
    if (delay_seconds && !options.min_age_is_given)
        options.protocol.min_age_seconds = *delay_seconds;
    return options;
}

TruePoses load_poses(const std::string& file,
                     const std::string& sensor,
                     const std::vector<FrameVerdict>& frames)
{
    return is_rawlog(file) ? poses_in_rawlog(file, sensor, frames) : load_true_poses(file, frames);
}

std::optional<TruePoses> true_poses_for(const TruthOptions& options,
                                        GroundTruth& truth,
                                        const std::vector<FrameVerdict>& frames)
{
    if (options.trajectory.empty()) return std::move(truth.poses);
    return load_poses(options.trajectory, options.sensor, frames);
}

GroundTruth load_truth(const TruthOptions& options, const std::vector<FrameVerdict>& frames)
{
    if (!is_rawlog(options.file)) return load_ground_truth(options.file, frames, options.protocol);
    return ground_truth_of(poses_in_rawlog(options.file, options.sensor, frames), options.protocol);
}

}  // namespace fild
