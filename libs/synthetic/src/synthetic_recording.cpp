// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/synthetic_recording.h"

#include "drawing_threads.h"
#include "fild/core/words.h"
#include "fild/rawlog/pose_conversion.h"
#include "fild/rawlog/robot_path_file.h"
#include "fild/synthetic/odometry.h"
#include "fild/synthetic/road_users.h"
#include "lens.h"
#include "observations.h"
#include "recording_files.h"

#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

namespace fild
{
namespace
{
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;

const TSyntheticOptions& checked(const TSyntheticOptions& options)
{
    options.check();
    return options;
}

std::uint64_t seed_of(const TSyntheticOptions& options)
{
    return static_cast<std::uint64_t>(options.town.seed);
}

std::vector<TPose3D> measured_odometry(const TSyntheticOptions& options,
                                       const std::vector<RoutePose>& route)
{
    std::vector<TPose3D> truth;
    truth.reserve(route.size());
    for (const auto& pose : route) truth.push_back(pose.map_from_robot);
    const auto dimensions = options.sensors.odometry == OdometryKind::robot_pose
                                ? OdometryDimensions::spatial
                                : OdometryDimensions::planar;
    return drifting_odometry(truth, dimensions, options.sensors.drift_percent, seed_of(options));
}

/** The route without an end by max_frames: road users are the same however long a recording is. */
std::vector<RoutePose> whole_route(const TSyntheticOptions& options, const StreetGrid& grid)
{
    auto whole = options.route;
    whole.max_frames = 0;
    return plan_route(whole, grid, seed_of(options));
}

/** "frame_000012.jpg", or "frame_000012_left.jpg" and "..._right.jpg". */
std::string image_name(std::size_t frame, std::size_t camera, std::size_t cameras)
{
    std::array<char, 64> name{};
    const char* const side = cameras == 1 ? "" : (camera == 0 ? "_left" : "_right");
    std::snprintf(name.data(), name.size(), "frame_%06zu%s.jpg", frame, side);
    return name.data();
}

/** What the truth is made with: the camera without its lens. */
CameraModel pinhole_of(const TSensorOptions& options)
{
    auto camera = camera_of(options);
    camera.lens = LensModel::none;
    camera.distortion.fill(0);
    return camera;
}

std::vector<StampedPose> true_path(const std::vector<RoutePose>& route)
{
    std::vector<StampedPose> path;
    path.reserve(route.size());
    for (const auto& pose : route)
    {
        const auto& p = pose.map_from_robot;
        const auto q = mrpt::poses::CPose3DQuat(CPose3D(p)).quat();
        const double sign = q.r() < 0 ? -1 : 1;  // of the two that mean the same rotation
        path.push_back({kRecordingStart + pose.seconds,
                        p.x,
                        p.y,
                        p.z,
                        sign * q.x(),
                        sign * q.y(),
                        sign * q.z(),
                        sign * q.r()});
    }
    return path;
}

/** A recording in the making: one frame after the other. */
class Recorder
{
 public:
    Recorder(const SyntheticRequest& request, const StreetGrid& grid)
        : options_(checked(request.options)),
          route_(plan_route(options_.route, grid, seed_of(options_))),
          odometry_(measured_odometry(options_, route_)),
          road_users_(
              options_.conditions.occluders, whole_route(options_, grid), grid, seed_of(options_)),
          files_(request.rawlog_path, request.embed),
          lens_(camera_of(options_.sensors)),
          loops_(options_.truth, pinhole_of(options_.sensors))
    {
    }

    /** What there is to see at a frame. May run concurrently, with itself and with record(). */
    DrawnFrame look(std::size_t frame, const DrawView& draw) const;
    void record(std::size_t frame, const DrawnFrame& seen);
    SyntheticSummary finish();

    std::size_t frames() const { return route_.size(); }
    std::size_t loops() const { return loops_.pairs().size(); }

 private:
    /** Where the robot is when a camera records, of the frame's cameras. */
    CPose3D map_from_robot(std::size_t frame, std::size_t camera) const;
    void write(std::size_t frame, const DrawnFrame& seen);
    mrpt::obs::CObservation::Ptr odometry_observation(std::size_t frame) const;

    TSyntheticOptions options_;
    std::vector<RoutePose> route_;
    std::vector<TPose3D> odometry_;  ///< start_from_robot of each frame
    RoadUsers road_users_;
    RecordingFiles files_;
    Lens lens_;
    OverlapLoops loops_;
};

void Recorder::record(std::size_t frame, const DrawnFrame& seen)
{
    const auto& pose = route_[frame];
    write(frame, seen);
    const CPose3D robot_from_camera(robot_from_cameras(options_.sensors).front());
    const auto map_from_camera = CPose3D(pose.map_from_robot) + robot_from_camera;
    loops_.add(pose.seconds, map_from_camera.asTPose(), seen.depth);
}

CPose3D Recorder::map_from_robot(std::size_t frame, std::size_t camera) const
{
    CPose3D now(route_[frame].map_from_robot);
    const bool is_late = options_.sensors.sensor == SensorKind::pair && camera == 1;
    if (!is_late || route_.size() < 2) return now;
    // The last frame goes on as the one before it.
    const auto& from = route_[std::min(frame, route_.size() - 2)];
    const auto& to = route_[std::min(frame, route_.size() - 2) + 1];
    const auto motion =
        rigid_transform_from(CPose3D(to.map_from_robot) - CPose3D(from.map_from_robot));
    const double share = options_.sensors.right_delay_seconds / (to.seconds - from.seconds);
    return now +
           mrpt_pose_from({rotation_from_vector(share * vector_from_rotation(motion.rotation)),
                           share * motion.translation});
}

DrawnFrame Recorder::look(std::size_t frame, const DrawView& draw) const
{
    const auto& pose = route_[frame];
    auto conditions = conditions_of_lap(options_.conditions, pose.lap, seed_of(options_));
    conditions.road_users = road_users_.at(frame);
    const auto cameras = robot_from_cameras(options_.sensors);
    DrawnFrame seen;
    for (std::size_t i = 0; i < cameras.size(); ++i)
    {
        const auto map_from_camera = map_from_robot(frame, i) + CPose3D(cameras[i]);
        const auto view = lens_.view([&](const CameraModel& pinhole)
                                     { return draw(pinhole, map_from_camera, conditions); });
        seen.images.push_back(with_image_effects(
            view.image, options_.conditions, seed_of(options_), frame * cameras.size() + i));
        if (i == 0) seen.depth = view.depth;
    }
    return seen;
}

void Recorder::write(std::size_t frame, const DrawnFrame& seen)
{
    std::vector<mrpt::img::CImage> images;
    for (std::size_t i = 0; i < seen.images.size(); ++i)
        images.push_back(
            files_.add_image(image_name(frame, i, seen.images.size()), seen.images[i]));
    const auto& sensors = options_.sensors;
    const auto& pose = route_[frame];
    const auto stamp = mrpt::Clock::fromDouble(kRecordingStart + pose.seconds);
    mrpt::obs::CSensoryFrame observations;
    if (const auto odometry = odometry_observation(frame)) observations.insert(odometry);
    if (sensors.gps)
        observations.insert(
            gps_observation(sensors, stamp, pose.map_from_robot, seed_of(options_), frame));
    for (const auto& observation : camera_observations(sensors, stamp, images, seen.depth))
        observations.insert(observation);
    if (sensors.odometry == OdometryKind::action)
    {
        const auto& before = odometry_[frame == 0 ? 0 : frame - 1];
        files_.rawlog().write(movement_action(stamp, before, odometry_[frame]), observations);
        return;
    }
    for (const auto& observation : observations) files_.rawlog().write(*observation);
}

/** Nothing when the odometry is no observation. */
mrpt::obs::CObservation::Ptr Recorder::odometry_observation(std::size_t frame) const
{
    const auto stamp = mrpt::Clock::fromDouble(kRecordingStart + route_[frame].seconds);
    switch (options_.sensors.odometry)
    {
        case OdometryKind::planar:
            return planar_odometry_observation(stamp, odometry_[frame]);
        case OdometryKind::robot_pose:
        {
            const double metres = options_.route.speed_m_per_s * route_[frame].seconds;
            return robot_pose_observation(
                stamp,
                odometry_[frame],
                odometry_deviation(options_.sensors.drift_percent, metres));
        }
        default:
            return nullptr;
    }
}

SyntheticSummary Recorder::finish()
{
    write_robot_path(files_.poses(), true_path(route_));
    write_loops(files_.loops(), options_.truth, loops_.pairs(), loops_.doubtful_pairs());
    SyntheticSummary summary;
    summary.paths = files_.commit();
    summary.frames = route_.size();
    summary.loops = loops_.pairs().size();
    std::set<FrameId> queries;
    for (const auto& pair : loops_.pairs()) queries.insert(pair.query);
    summary.queries_with_loop = queries.size();
    summary.metres = driven_metres(route_);
    return summary;
}
}  // namespace

SyntheticSummary write_synthetic_recording(const SyntheticRequest& request,
                                           const StreetGrid& grid,
                                           const DrawView& draw,
                                           const OnFrame& on_frame,
                                           const DrawingHelpers& helpers)
{
    Recorder recorder(request, grid);
    DrawingThreads threads(recorder.frames(),
                           draw,
                           helpers,
                           [&](std::size_t frame, const DrawView& means)
                           { return recorder.look(frame, means); });
    for (std::size_t frame = 0; frame < recorder.frames(); ++frame)
    {
        recorder.record(frame, threads.frame(frame));
        if (on_frame) on_frame(frame + 1, recorder.frames(), recorder.loops());
    }
    return recorder.finish();
}

std::string to_text(const SyntheticSummary& summary)
{
    const std::vector<std::string> beside(summary.paths.begin() + 1, summary.paths.end());
    return summary.paths.front() + ": " + count_of(summary.frames, "frame") + ", " +
           std::to_string(static_cast<long>(summary.metres)) + " m, " +
           count_of(summary.queries_with_loop, "frame") + " with a loop (" +
           count_of(summary.loops, "pair") + "); beside it: " + joined(beside, ", ");
}

}  // namespace fild
