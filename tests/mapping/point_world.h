// SPDX-License-Identifier: BSD-3-Clause
// A robot drives twice round a circle within a wall of points that all have a code of their own:
// descriptions of what its camera sees, without an image.
#pragma once

#include "fild/core/random.h"
#include "fild/core/rigid_transform.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/loop_detector.h"
#include "fild/detector/loop_poses.h"
#include "fild/mapping/map_builder.h"
#include "fild/rawlog/pose_conversion.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose3D.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace fild::testing
{
constexpr std::size_t kFramesPerLap = 36;
constexpr std::size_t kFrames = 2 * kFramesPerLap;
constexpr std::size_t kDescriptorLength = 32;

/** What a recording has. */
struct Recorded
{
    bool depth = true;
    bool odometry = true;
    bool calibration = true;
    std::function<void(MapBuilder&, std::size_t frame)> feed_more{};  ///< before each frame
    std::function<void(MapBuilder&, const DetectorOutcome&)> add_more{};  ///< after each outcome
    TGraphOptions graph{};
};

/** The two laps. */
class PointWorld
{
 public:
    PointWorld()
    {
        std::mt19937_64 generator(1);
        constexpr std::size_t kPoints = 1200;
        constexpr double kWallRadius = 18;
        points_.resize(kPoints);
        for (auto& point : points_)
        {
            const double angle = uniform(generator) * 2 * kPi;
            const double radius = kWallRadius + 3 * uniform(generator);
            point.position = {
                radius * std::cos(angle), radius * std::sin(angle), 7 * uniform(generator) - 2};
            for (auto& word : point.code) word = generator();
        }
    }

    /** Pose of the robot; the second lap runs half a metre beside the first. */
    static mrpt::poses::CPose3D map_from_robot(std::size_t frame)
    {
        const double angle = 2 * kPi * static_cast<double>(frame) / kFramesPerLap;
        const double radius = frame < kFramesPerLap ? 10 : 10.5;
        return {radius * std::cos(angle), radius * std::sin(angle), 0, angle + kPi / 2, 0, 0};
    }

    static mrpt::poses::CPose3D robot_from_camera() { return {0.4, 0.1, 1, -kPi / 2, 0, -kPi / 2}; }

    static CameraModel camera() { return {400, 400, 320, 240, 640, 480, LensModel::none, {}}; }

    /** What is seen, with pixels and depths as noisy as they say. */
    FrameDescription describe(std::size_t frame, const Recorded& recorded) const
    {
        FrameDescription seen;
        seen.frame = FrameId{frame};
        seen.timestamp = static_cast<double>(frame);
        seen.sensor_label = "CAMERA1";
        seen.global = descriptor(frame % kFramesPerLap);
        seen.local.codes.bits = 256;
        seen.local.codes.words_per_code = 4;
        seen.metric.robot_from_camera = rigid_transform_from(robot_from_camera());
        if (recorded.calibration) seen.metric.camera = camera();
        if (recorded.depth) seen.metric.depths.source = DepthSource::depth_image;
        std::mt19937_64 noise(frame + 100);
        const auto camera_from_map =
            rigid_transform_from(map_from_robot(frame) + robot_from_camera()).inverse();
        for (const auto& point : points_) add(seen, point, camera_from_map * point.position, noise);
        if (!recorded.depth) seen.metric.depths = {};
        return seen;
    }

 private:
    static constexpr double kPi = 3.14159265358979323846;
    static constexpr double kPixelDeviation = 0.3;
    static constexpr double kRelativeDepthDeviation = 0.005;

    struct Point
    {
        cv::Vec3d position;
        std::array<std::uint64_t, 4> code{};
    };

    static double uniform(std::mt19937_64& generator)
    {
        return static_cast<double>(generator() >> 11U) * 0x1.0p-53;
    }

    static GlobalDescriptor descriptor(std::size_t place)
    {
        std::mt19937_64 generator(place + 7);
        GlobalDescriptor numbers(kDescriptorLength);
        double squares = 0;
        for (auto& number : numbers)
        {
            number = static_cast<float>(standard_normal(generator));
            squares += static_cast<double>(number) * static_cast<double>(number);
        }
        for (auto& number : numbers) number /= static_cast<float>(std::sqrt(squares));
        return numbers;
    }

    static void add(FrameDescription& seen,
                    const Point& point,
                    const cv::Vec3d& in_camera,
                    std::mt19937_64& noise)
    {
        const auto model = camera();
        if (in_camera[2] < 1 || in_camera[2] > 20) return;
        const double x = model.fx * in_camera[0] / in_camera[2] + model.cx;
        const double y = model.fy * in_camera[1] / in_camera[2] + model.cy;
        if (x < 0 || y < 0 || x > model.width - 1 || y > model.height - 1) return;
        seen.local.positions.push_back(
            {static_cast<float>(x + kPixelDeviation * standard_normal(noise)),
             static_cast<float>(y + kPixelDeviation * standard_normal(noise))});
        auto& words = seen.local.codes.words;
        words.insert(words.end(), point.code.begin(), point.code.end());
        const double deviation = kRelativeDepthDeviation * in_camera[2];
        auto& depths = seen.metric.depths;
        depths.metres.push_back(
            static_cast<float>(in_camera[2] + deviation * standard_normal(noise)));
        depths.deviations_m.push_back(static_cast<float>(deviation));
    }

    std::vector<Point> points_;
};

inline TDetectorOptions detector_options()
{
    TDetectorOptions options;
    options.index.delay_seconds = 20;
    options.consistency.consecutive_frames = 1;
    return options;
}

/** A reading of wheels that take each metre for 1.02 and turn 2 % too little. */
inline mrpt::obs::CObservationOdometry drifting_odometry(std::size_t frame)
{
    mrpt::poses::CPose2D pose;
    for (std::size_t i = 1; i <= frame; ++i)
    {
        const auto step = PointWorld::map_from_robot(i) - PointWorld::map_from_robot(i - 1);
        pose = pose + mrpt::poses::CPose2D(1.02 * step.x(), 1.02 * step.y(), 0.98 * step.yaw());
    }
    mrpt::obs::CObservationOdometry reading;
    reading.sensorLabel = "ODOMETRY";
    reading.timestamp = mrpt::Clock::fromDouble(static_cast<double>(frame));
    reading.odometry = pose;
    return reading;
}

/** Drives the first frames through detector and map. */
template <class Change>
Map map_of(
    std::size_t frames,
    const Recorded& recorded,
    const TDetectorOptions& options,
    Change&& change,
    const CheckCancelled& check_cancelled = [] {})
{
    const PointWorld world;
    PlaceMap places;
    LoopDetector detector(options, kDescriptorLength, places);
    const LoopPoses poses(options);
    MapBuilder builder(options, recorded.graph);
    StageTimes times;
    const auto add = [&](DetectorOutcome& outcome)
    {
        poses.add_pose(outcome, places, times);
        builder.add(outcome);
    };
    for (std::size_t i = 0; i < frames; ++i)
    {
        if (recorded.odometry) builder.feed(drifting_odometry(i));
        if (recorded.feed_more) recorded.feed_more(builder, i);
        auto description = world.describe(i, recorded);
        change(description);
        builder.add_frame(description.frame, description.timestamp);
        for (auto& outcome : detector.process(std::move(description), times))
        {
            add(outcome);
            if (recorded.add_more) recorded.add_more(builder, outcome);
        }
    }
    for (auto& outcome : detector.finish(times)) add(outcome);
    return builder.build(places, times, check_cancelled);
}

inline Map map_of(const Recorded& recorded, const TDetectorOptions& options = detector_options())
{
    return map_of(kFrames, recorded, options, [](FrameDescription&) {});
}

/** Root mean square distance from the truth of poses that begin where it begins. */
inline double error_of(const std::vector<TrajectoryPose>& poses)
{
    if (poses.empty()) return std::nan("");
    const auto first = to_index(poses.front().frame);
    const auto truth_from_map =
        PointWorld::map_from_robot(first) + (mrpt::poses::CPose3D() - poses.front().map_from_robot);
    double squares = 0;
    for (const auto& pose : poses)
        squares += std::pow((truth_from_map + pose.map_from_robot)
                                .distanceTo(PointWorld::map_from_robot(to_index(pose.frame))),
                            2);
    return std::sqrt(squares / static_cast<double>(poses.size()));
}

}  // namespace fild::testing
