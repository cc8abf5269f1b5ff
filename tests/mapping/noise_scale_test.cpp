// SPDX-License-Identifier: BSD-3-Clause
#include "noise_scale.h"

#include "fild/core/random.h"
#include "fild/graph/trajectory_frame.h"
#include "motion_fusion.h"

#include <gtest/gtest.h>
#include <mrpt/math/CMatrixFixed.h>

#include <cmath>
#include <random>

namespace
{
using fild::FrameId;
using fild::fused_motion;
using fild::MeasuredMotion;
using fild::noise_scale_of;
using fild::noise_scales;
using fild::Trajectory;
using fild::trajectory_from_motions;
using mrpt::poses::CPose3D;

constexpr std::size_t kSteps = 400;

mrpt::math::CMatrixDouble66 covariance_of(double metres, double radians)
{
    mrpt::math::CMatrixDouble66 covariance;
    for (int i = 0; i < 6; ++i) covariance(i, i) = i < 3 ? metres * metres : radians * radians;
    return covariance;
}

/** A drive of a metre a step that bends to the left, measured with errors. */
Trajectory measured(double stated_sigma, double true_sigma, double scale, std::uint64_t seed)
{
    constexpr double kAngle = 0.1;  // radians of error a metre of error
    std::mt19937_64 noise(seed);
    const auto error = [&] { return true_sigma * fild::standard_normal(noise); };
    std::vector<MeasuredMotion> motions;
    for (std::size_t i = 0; i < kSteps; ++i)
    {
        const CPose3D step(scale + error(),
                           error(),
                           error(),
                           0.02 + kAngle * error(),
                           kAngle * error(),
                           kAngle * error());
        motions.push_back({FrameId{i},
                           FrameId{i + 1},
                           static_cast<double>(i),
                           static_cast<double>(i + 1),
                           {step, covariance_of(stated_sigma, kAngle * stated_sigma)}});
    }
    return trajectory_from_motions(motions);
}

TEST(NoiseScale, IsThatOfTheMedian)
{
    const double median = 5.348;  // of chi2 with 6 degrees of freedom
    EXPECT_NEAR(noise_scale_of({0, 9 * median, 9 * median, 9 * median, 1e9}, 6), 3, 0.01);
    EXPECT_EQ(noise_scale_of({0, 0, 0, 0, 0}, 6), 1) << "never less than stated";
    EXPECT_EQ(noise_scale_of({1e9, 1e9, 1e9, 1e9, 1e9}, 6), fild::kLargestNoiseScale);
    EXPECT_EQ(noise_scale_of({1e9, 1e9}, 6), 1) << "too few to tell";
}

TEST(NoiseScale, IsNotThatOfGrossErrors)
{
    std::mt19937_64 noise(1);
    std::vector<double> errors;
    for (int i = 0; i < 1000; ++i)
    {
        double sum = 0;
        for (int k = 0; k < 6; ++k) sum += 4 * std::pow(fild::standard_normal(noise), 2);
        errors.push_back(i % 2 == 0 ? sum : 1e6);
    }
    EXPECT_LT(noise_scale_of(errors, 6, 0.25), 2.6);
    EXPECT_GT(noise_scale_of(errors, 6, 0.25), 1.9);
}

TEST(NoiseScales, ArePutDownToTheLessCertainSource)
{
    const auto images = measured(0.01, 0.01, 1, 1);
    const auto as_stated = noise_scales(measured(0.1, 0.1, 1, 2), images);
    EXPECT_LT(as_stated.odometry, 1.5);
    EXPECT_EQ(as_stated.vision, 1);
    const auto worse = noise_scales(measured(0.1, 0.4, 1, 3), images);
    EXPECT_GT(worse.odometry, 3);
    EXPECT_LT(worse.odometry, 6);
    EXPECT_EQ(worse.vision, 1);
    EXPECT_GT(noise_scales(measured(0.1, 0.1, 1.05, 4), images).odometry, 1.5) << "5 % too long";
}

TEST(FusedMotion, LiesBetweenItsSourcesAsTheirCovariancesSay)
{
    const auto one = measured(0.02, 0, 1, 1);
    const auto other = measured(0.01, 0, 1.01, 1);
    const auto fused = fused_motion(one, 1, other, 1);
    ASSERT_EQ(fused.motions.size(), kSteps);
    EXPECT_EQ(fused.from_both, kSteps);
    EXPECT_EQ(fused.contradictions, 0U);
    const auto& motion = fused.motions.front().motion;
    EXPECT_NEAR(motion.a_from_b.x(), 1.008, 1e-3);
    EXPECT_LT(std::sqrt(motion.covariance(0, 0)), 0.0105);
}

TEST(FusedMotion, DoubtsBothWhereTheyContradictEachOther)
{
    const auto fused = fused_motion(measured(0.01, 0, 0, 1), 1, measured(0.01, 0, 1, 1), 1);
    EXPECT_EQ(fused.contradictions, kSteps);
    const auto& motion = fused.motions.front().motion;
    EXPECT_GT(std::sqrt(motion.covariance(0, 0)), 0.5);
    EXPECT_LT(std::sqrt(motion.covariance(1, 1)), 0.02) << "they agree on this";
    EXPECT_NEAR(fild::length_ratio(measured(0.01, 0, 0.5, 1), measured(0.01, 0, 1, 1)), 0.5, 0.01);
}

TEST(FusedMotion, BridgesWhatOneSourceDoesNotKnow)
{
    const auto images = measured(0.01, 0, 1, 1);
    const auto odometry = measured(0.02, 0, 1, 1);
    std::vector<Trajectory::Frame> some;
    for (const auto& frame : images.frames())
        if (to_index(frame.id) < 100 || to_index(frame.id) > 120) some.push_back(frame);
    for (auto& frame : some) frame.at.segment = to_index(frame.id) > 120 ? 1 : 0;
    const auto fused = fused_motion(odometry, 1, Trajectory(some, {}), 1);
    EXPECT_EQ(fused.motions.size(), kSteps);
    EXPECT_EQ(fused.from_odometry, 22U);
    const auto joined = trajectory_from_motions(fused.motions);
    EXPECT_TRUE(joined.motion(FrameId{0}, FrameId{kSteps}));
}

}  // namespace
