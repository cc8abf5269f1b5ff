// SPDX-License-Identifier: BSD-3-Clause
#include "noise_scale.h"

#include "fild/graph/uncertain_motion.h"

#include <mrpt/math/distributions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr std::size_t kFewestErrors = 5;

/** What two sources say of one stretch. */
struct Stretch
{
    double squared_error = 0;
    double odometry_share = 0;  ///< of the variance
};

std::optional<Stretch> compare(const Trajectory& odometry,
                               const Trajectory& vision,
                               FrameId a,
                               FrameId b)
{
    const auto driven = odometry.motion(a, b);
    const auto seen = vision.motion(a, b);
    if (!driven || !seen) return std::nullopt;
    const auto one = to_uncertain(*driven);
    const auto other = to_uncertain(*seen);
    const Matrix6 sum = one.covariance + other.covariance;
    const double share = sum.ldlt().solve(one.covariance).trace() / 6;
    return Stretch{squared_error({one.motion.inverse() * other.motion, sum}), share};
}

/** Stretches of the same length, one after the other. */
std::vector<Stretch> stretches_of(double metres,
                                  const Trajectory& odometry,
                                  const Trajectory& vision)
{
    std::vector<Stretch> stretches;
    const auto& poses = vision.poses();
    double way = 0;
    std::size_t begin = 0;
    for (std::size_t i = 1; i < poses.size(); ++i)
    {
        way += poses[i].map_from_robot.distanceTo(poses[i - 1].map_from_robot);
        if (way < metres) continue;
        if (const auto stretch = compare(odometry, vision, poses[begin].frame, poses[i].frame))
            stretches.push_back(*stretch);
        begin = i;
        way = 0;
    }
    return stretches;
}
}  // namespace

double noise_scale_of(std::vector<double> squared_errors, int degrees_of_freedom, double quantile)
{
    if (squared_errors.size() < kFewestErrors) return 1;
    const auto place =
        static_cast<std::ptrdiff_t>(quantile * static_cast<double>(squared_errors.size()));
    const auto error = squared_errors.begin() + place;
    std::nth_element(squared_errors.begin(), error, squared_errors.end());
    const double expected =
        mrpt::math::chi2inv(quantile, static_cast<unsigned int>(degrees_of_freedom));
    return std::clamp(std::sqrt(*error / expected), 1.0, kLargestNoiseScale);
}

NoiseScales noise_scales(const Trajectory& odometry, const Trajectory& vision)
{
    constexpr double kNotable = 0.2;  // share of the variance
    NoiseScales scales;
    for (const double metres : {10.0, 30.0, 100.0, 300.0})
    {
        const auto stretches = stretches_of(metres, odometry, vision);
        if (stretches.size() < kFewestErrors) continue;
        std::vector<double> errors;
        double share = 0;
        for (const auto& stretch : stretches)
        {
            errors.push_back(stretch.squared_error);
            share += stretch.odometry_share / static_cast<double>(stretches.size());
        }
        const double scale = noise_scale_of(std::move(errors), 6);
        if (share > kNotable) scales.odometry = std::max(scales.odometry, scale);
        if (1 - share > kNotable) scales.vision = std::max(scales.vision, scale);
    }
    return scales;
}

}  // namespace fild
