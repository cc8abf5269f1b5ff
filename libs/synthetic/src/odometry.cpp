// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/odometry.h"

#include "fild/core/random.h"
#include "seeded_generator.h"
#include "smooth_noise.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;

// Standard deviations for a drift of 1 %. Chosen so that after 100 m of a straight road the errors
// along and across it are of equal size, and their mean length is 1 m; odometry_test measures it.
constexpr double kScaleBias = 0.009;  // m/m
constexpr double kScaleNoise = 0.035;  // m per square root of a metre
constexpr double kHeadingBias = 1.6e-4;  // rad/m
constexpr double kHeadingNoise = 5e-4;  // rad per square root of a metre
constexpr double kTurnBias = 0.005;  // rad/rad
constexpr double kTurnNoise = 0.003;  // rad per square root of a radian
constexpr double kClimbBias = 0.0025;  // m/m

constexpr double kBiasKnots = 50;  // m

TPose3D flattened(const TPose3D& pose)
{
    return {pose.x, pose.y, 0, pose.yaw, 0, 0};
}

/** True movements from pose to pose. */
std::vector<CPose3D> movements(const std::vector<TPose3D>& poses, OdometryDimensions dimensions)
{
    const auto measurable = [&](const TPose3D& pose)
    { return CPose3D(dimensions == OdometryDimensions::planar ? flattened(pose) : pose); };
    std::vector<CPose3D> steps;
    for (std::size_t i = 1; i < poses.size(); ++i)
        steps.push_back(measurable(poses[i]) - measurable(poses[i - 1]));
    return steps;
}

/** Turns true movements into measured ones, in order. */
class Drift
{
 public:
    Drift(double percent, double length, std::uint64_t seed)
        : percent_(percent),
          scale_(bias(length, seed, 0)),
          heading_(bias(length, seed, 1)),
          turn_(bias(length, seed, 2)),
          climb_(bias(length, seed, 3)),
          noise_(seeded_generator(seed, RandomPurpose::odometry_noise, 0))
    {
    }

    CPose3D measured(const CPose3D& step)
    {
        const double way = step.norm();
        const double turn = std::abs(step.yaw());
        const double stretched =
            way * kScaleBias * scale_.value(way_) +
            std::sqrt(way) * kScaleNoise * standard_normal(noise_);  // m along the movement
        const double turned = way * kHeadingBias * heading_.value(way_) +
                              std::sqrt(way) * kHeadingNoise * standard_normal(noise_) +
                              turn * kTurnBias * turn_.value(way_) +
                              std::sqrt(turn) * kTurnNoise * standard_normal(noise_);
        const double climbed = way * kClimbBias * climb_.value(way_);
        way_ += way;
        const double factor = way > 0 ? 1 + percent_ * stretched / way : 1;
        const CPose3D straight(
            factor * step.x(), factor * step.y(), step.z(), step.yaw(), step.pitch(), step.roll());
        return CPose3D(0, 0, percent_ * climbed, percent_ * turned / 2, 0, 0) + straight +
               CPose3D(0, 0, 0, percent_ * turned / 2, 0, 0);
    }

 private:
    static SmoothNoise bias(double length, std::uint64_t seed, std::uint64_t index)
    {
        return {length, kBiasKnots, seeded_generator(seed, RandomPurpose::odometry_bias, index)};
    }

    double percent_;
    double way_ = 0;  ///< true, up to now, m
    SmoothNoise scale_;
    SmoothNoise heading_;
    SmoothNoise turn_;
    SmoothNoise climb_;
    std::mt19937_64 noise_;
};
}  // namespace

std::vector<TPose3D> drifting_odometry(const std::vector<TPose3D>& map_from_robot,
                                       OdometryDimensions dimensions,
                                       double drift_percent,
                                       std::uint64_t seed)
{
    if (!(drift_percent >= 0))
        throw std::invalid_argument("drifting_odometry: drift_percent=" +
                                    std::to_string(drift_percent));
    const auto steps = movements(map_from_robot, dimensions);
    double length = 0;
    for (const auto& step : steps) length += step.norm();
    Drift drift(drift_percent, length, seed);
    std::vector<TPose3D> odometry;
    CPose3D start_from_robot;
    for (std::size_t i = 0; i < map_from_robot.size(); ++i)
    {
        if (i > 0)
        {
            auto step = drift.measured(steps[i - 1]);
            if (dimensions == OdometryDimensions::planar) step = CPose3D(flattened(step.asTPose()));
            start_from_robot = start_from_robot + step;
        }
        odometry.push_back(start_from_robot.asTPose());
    }
    return odometry;
}

OdometryDeviation odometry_deviation(double drift_percent, double metres)
{
    return {std::max(1e-3, drift_percent * metres / 100),
            std::max(1e-4, drift_percent * metres * kHeadingBias)};
}

}  // namespace fild
