// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/random.h"
#include "fild/graph/graph_builder.h"
#include "fild/mapping/trajectory_builder.h"
#include "fild/synthetic/odometry.h"
#include "fild/synthetic/route.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPose2D.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

namespace fild::testing
{
/** Standard deviations of a simulated loop, as a stereo camera measures it. */
constexpr double kLoopSigma = 0.03;  // m
constexpr double kLoopSigmaAngle = 0.005;  // rad

/** Two laps through the town's streets: where the robot truly is, and what its odometry says. */
struct SimulatedDrive
{
    std::vector<mrpt::poses::CPose3D> truth;  ///< frame i at second i
    std::vector<mrpt::math::TPose3D> odometry;
};

inline SimulatedDrive simulate_drive(OdometryDimensions dimensions,
                                     std::uint64_t seed,
                                     double drift_percent = 1.5)
{
    TRouteOptions options;
    if (dimensions == OdometryDimensions::planar) options.suspension_deg = 0;
    std::vector<mrpt::math::TPose3D> poses;
    for (const auto& pose : plan_route(options, {}, seed)) poses.push_back(pose.map_from_robot);
    SimulatedDrive drive;
    drive.odometry = drifting_odometry(poses, dimensions, drift_percent, seed);
    for (const auto& pose : poses) drive.truth.emplace_back(pose);
    return drive;
}

inline mrpt::math::CMatrixDouble66 loop_covariance()
{
    mrpt::math::CMatrixDouble66 covariance;
    for (int i = 0; i < 6; ++i)
        covariance(i, i) = std::pow(i < 3 ? kLoopSigma : kLoopSigmaAngle, 2);
    return covariance;
}

/** A pose off by errors as loop_covariance() tells. */
inline mrpt::poses::CPose3D with_loop_noise(const mrpt::poses::CPose3D& pose,
                                            std::mt19937_64& noise)
{
    const auto metres = [&] { return kLoopSigma * standard_normal(noise); };
    const auto radians = [&] { return kLoopSigmaAngle * standard_normal(noise); };
    return {pose.x() + metres(),
            pose.y() + metres(),
            pose.z() + metres(),
            pose.yaw() + radians(),
            pose.pitch() + radians(),
            pose.roll() + radians()};
}

/** Loops between frames that are truly close and look the same way, every `stride` frames. */
inline std::vector<LoopMeasurement> true_loops(const SimulatedDrive& drive,
                                               std::size_t stride,
                                               std::uint64_t seed)
{
    constexpr std::size_t kApart = 60;  // frames
    std::mt19937_64 noise(seed);
    std::vector<LoopMeasurement> loops;
    for (std::size_t query = kApart; query < drive.truth.size(); query += stride)
        for (std::size_t candidate = 0; candidate + kApart < query; ++candidate)
        {
            const auto a_from_b = drive.truth[query] - drive.truth[candidate];
            if (a_from_b.norm() > 2 || std::abs(a_from_b.yaw()) > 0.5) continue;
            loops.push_back({FrameId{candidate},
                             FrameId{query},
                             {with_loop_noise(a_from_b, noise), loop_covariance()}});
            break;
        }
    return loops;
}

/** The poses up to the last query: what the loops can tell of. The synthetic route goes on from
 * there for a while and ends without a loop. */
inline std::vector<mrpt::poses::CPose3D> until_last_query(std::vector<mrpt::poses::CPose3D> poses,
                                                          const std::vector<LoopMeasurement>& loops)
{
    std::uint64_t last = 0;
    for (const auto& loop : loops) last = std::max(last, to_index(loop.query));
    poses.resize(last + 1);
    return poses;
}

/** A number in [0, count), without the library's own distributions. */
inline std::size_t pick(std::mt19937_64& generator, std::size_t count)
{
    return static_cast<std::size_t>(generator() % count);
}

/** Loops between any two frames, each with the motion of a right one. */
inline std::vector<LoopMeasurement> random_false_loops(const SimulatedDrive& drive,
                                                       std::size_t count,
                                                       std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    std::vector<LoopMeasurement> loops;
    while (loops.size() < count)
    {
        const auto a = pick(generator, drive.truth.size());
        const auto b = pick(generator, drive.truth.size());
        if (a >= b || drive.truth[a].distanceTo(drive.truth[b]) < 5) continue;
        loops.push_back({FrameId{a},
                         FrameId{b},
                         {with_loop_noise(mrpt::poses::CPose3D(), generator), loop_covariance()}});
    }
    return loops;
}

/** Loops as of streets that look alike: several frames in a row are each taken for one of a row
 *  elsewhere, so that they agree with each other. */
inline std::vector<LoopMeasurement> aliased_loops(const SimulatedDrive& drive,
                                                  std::size_t count,
                                                  std::uint64_t seed)
{
    constexpr std::size_t kRow = 8;
    std::mt19937_64 generator(seed);
    std::vector<LoopMeasurement> loops;
    while (loops.size() < count)
    {
        const auto a = pick(generator, drive.truth.size() - kRow);
        const auto b = pick(generator, drive.truth.size() - kRow);
        if (a + kRow >= b || drive.truth[a].distanceTo(drive.truth[b]) < 5) continue;
        for (std::size_t i = 0; i < kRow && loops.size() < count; ++i)
        {
            // The place of b + i is taken for that of a + i, with the way along a's street.
            const auto a_from_b =
                (drive.truth[b + i] - drive.truth[b]) - (drive.truth[a + i] - drive.truth[a]);
            loops.push_back({FrameId{a + i},
                             FrameId{b + i},
                             {with_loop_noise(a_from_b, generator), loop_covariance()}});
        }
    }
    return loops;
}

/** How a drive's odometry stands in the recording, as synthetic-rawlog writes it. */
enum class Recorded
{
    odometry,  ///< CObservationOdometry: planar, without covariance
    robot_pose,  ///< CObservationRobotPose, with a covariance that grows
    robot_pose_without_covariance,
    actions  ///< CActionRobotMovement2D, with MRPT's usual covariance
};

/** Feeds what was recorded at one frame. */
inline void feed_frame(TrajectoryBuilder& builder,
                       const SimulatedDrive& drive,
                       Recorded recorded,
                       std::size_t frame)
{
    using mrpt::poses::CPose2D;
    using mrpt::poses::CPose3D;
    const auto stamp = mrpt::Clock::fromDouble(static_cast<double>(frame));
    const CPose3D pose(drive.odometry[frame]);
    if (recorded == Recorded::odometry)
    {
        mrpt::obs::CObservationOdometry odometry;
        odometry.timestamp = stamp;
        odometry.odometry = CPose2D(pose);
        builder.feed(odometry);
        return;
    }
    if (recorded == Recorded::actions)
    {
        mrpt::obs::CActionRobotMovement2D movement;
        const CPose3D before(drive.odometry[frame == 0 ? 0 : frame - 1]);
        movement.computeFromOdometry(CPose2D(pose) - CPose2D(before), {});
        mrpt::obs::CActionCollection actions;
        actions.insert(movement);
        builder.feed(actions);
        mrpt::obs::CObservationImage image;
        image.timestamp = stamp;
        builder.feed(image);
        return;
    }
    mrpt::obs::CObservationRobotPose observation;
    observation.timestamp = stamp;
    observation.pose.mean = pose;
    if (recorded == Recorded::robot_pose)
    {
        constexpr double kDrift = 1.5;  // percent, as of simulate_drive()
        constexpr double kFrameWay = 2.5;  // m
        const auto sigma = odometry_deviation(kDrift, kFrameWay * static_cast<double>(frame));
        for (int i = 0; i < 6; ++i)
            observation.pose.cov(i, i) =
                std::pow(i < 3 ? sigma.position_m : (i == 3 ? sigma.heading_rad : 1e-3), 2);
    }
    builder.feed(observation);
}

/** The drive's odometry as it would be recorded, fed to a builder with its frames. */
inline Trajectory trajectory_of(const SimulatedDrive& drive,
                                Recorded recorded,
                                const TGraphOptions& options)
{
    TrajectoryBuilder builder(options);
    for (std::size_t i = 0; i < drive.odometry.size(); ++i)
    {
        feed_frame(builder, drive, recorded, i);
        builder.add_frame(FrameId{i}, static_cast<double>(i));
    }
    return builder.build();
}

/** Root mean square distance of two paths after the rigid motion that fits them best (Umeyama,
 *  1991, without scale), metres. */
inline double absolute_trajectory_error(const std::vector<mrpt::poses::CPose3D>& truth,
                                        const std::vector<mrpt::poses::CPose3D>& estimate)
{
    const auto count = static_cast<Eigen::Index>(truth.size());
    Eigen::Matrix3Xd to(3, count);
    Eigen::Matrix3Xd from(3, count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
        const auto& a = truth.at(static_cast<std::size_t>(i));
        const auto& b = estimate.at(static_cast<std::size_t>(i));
        to.col(i) << a.x(), a.y(), a.z();
        from.col(i) << b.x(), b.y(), b.z();
    }
    const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
    const Eigen::Matrix3Xd moved =
        (motion.topLeftCorner<3, 3>() * from).colwise() + motion.topRightCorner<3, 1>();
    return std::sqrt((moved - to).squaredNorm() / static_cast<double>(count));
}

}  // namespace fild::testing
