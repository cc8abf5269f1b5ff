// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/relative_pose.h"

#include "message_of.h"
#include "pose_refinement.h"
#include "pose_scene.h"

#include <opencv2/core.hpp>

#include <algorithm>

namespace
{
using namespace fild::testing;
using fild::DepthSource;
using fild::NoMetricPose;
using fild::RelativePose;
using fild::RelativePoseEstimator;
using fild::RigidTransform;
using fild::TRelativePoseOptions;

RelativePose estimate(const Scene& scene, const TRelativePoseOptions& options = {})
{
    return RelativePoseEstimator(options, 1)
        .estimate(scene.query_view(), scene.candidate_view(), scene.matches);
}

cv::Vec<double, 6> error_of(const RigidTransform& estimate, const RigidTransform& truth)
{
    const auto t = truth.translation - estimate.translation;
    const auto w = fild::vector_from_rotation(estimate.rotation.t() * truth.rotation);
    return {t[0], t[1], t[2], w[0], w[1], w[2]};
}

/** Normalised estimation error squared: chi-squared with six degrees of freedom where the
 * covariance is honest. */
double nees_of(const RelativePose& pose, const RigidTransform& truth)
{
    const auto error = error_of(pose.candidate_from_query->b_from_a, truth);
    return error.dot(pose.candidate_from_query->covariance.inv() * error);
}

/** Depths known in both frames, in the candidate only, in the query only. */
class EachDepth : public ::testing::TestWithParam<std::pair<bool, bool>>
{
 protected:
    static SceneRecipe recipe()
    {
        SceneRecipe recipe;
        recipe.query_depth = GetParam().first;
        recipe.candidate_depth = GetParam().second;
        return recipe;
    }
};

TEST_P(EachDepth, FindsTheExactPoseOfExactMeasurements)
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        const auto scene = make_scene(recipe(), seed);
        const auto pose = estimate(scene);
        ASSERT_TRUE(pose.candidate_from_query) << to_word(pose.reason);
        EXPECT_LT(
            cv::norm(error_of(pose.candidate_from_query->b_from_a, scene.candidate_from_query)),
            1e-4);
        EXPECT_EQ(pose.inliers.size(), scene.matches.size());
        EXPECT_EQ(pose.source, DepthSource::stereo);
    }
}

TEST_P(EachDepth, IsAsUncertainAsItSays)
{
    auto noisy = recipe();
    noisy.pixel_noise = 0.7;
    noisy.inverse_depth_noise = 0.002;
    noisy.outliers = 20;
    constexpr int kTrials = 150;
    double sum = 0;
    int beyond = 0;
    for (std::uint64_t seed = 1; seed <= kTrials; ++seed)
    {
        const auto scene = make_scene(noisy, seed);
        const auto pose = estimate(scene);
        ASSERT_TRUE(pose.candidate_from_query) << to_word(pose.reason) << " seed " << seed;
        const double nees = nees_of(pose, scene.candidate_from_query);
        sum += nees;
        beyond += nees > 22.458 ? 1 : 0;  // the 99.9 % quantile
        EXPECT_NEAR(pose.pixel_deviation_px, 0.7, 0.25);
    }
    EXPECT_GT(sum / kTrials, 4);  // 6 is exact; it is meant to be cautious
    EXPECT_LT(sum / kTrials, 6.5);
    EXPECT_LE(beyond, 1);
}

// A poster far away: wherever on the grid of regions it is, the covariance is not too small.
TEST_P(EachDepth, IsCautiousWhereAllPointsAreInOnePlaceOfTheImage)
{
    auto poster = recipe();
    poster.pixel_noise = 0.7;
    poster.inverse_depth_noise = 0.002;
    poster.half_width = 0.08;
    constexpr int kTrials = 60;
    double sum = 0;
    int poses = 0;
    for (std::uint64_t seed = 1; seed <= kTrials; ++seed)
    {
        const auto scene = make_scene(poster, seed);
        TRelativePoseOptions options;
        options.max_position_deviation_m = options.max_rotation_deviation_deg = 100;
        const auto pose = estimate(scene, options);
        if (!pose.candidate_from_query) continue;
        ++poses;
        sum += nees_of(pose, scene.candidate_from_query);
    }
    EXPECT_GE(poses, kTrials / 2);
    EXPECT_LT(sum / poses, 9);
}

TEST_P(EachDepth, LeavesWrongMatchesOut)
{
    auto mixed = recipe();
    mixed.points = 100;
    mixed.outliers = 50;
    mixed.pixel_noise = 0.5;
    const auto scene = make_scene(mixed, 3);
    const auto pose = estimate(scene);
    ASSERT_TRUE(pose.candidate_from_query) << to_word(pose.reason);
    const auto wrong = std::count_if(
        pose.inliers.begin(), pose.inliers.end(), [](std::size_t k) { return k >= 100; });
    EXPECT_LE(wrong, 3);
    EXPECT_GE(pose.inliers.size(), 95U);
    EXPECT_EQ(pose.with_depth, 150U);
    EXPECT_NEAR(pose.inlier_share, 0.66, 0.04);
}

INSTANTIATE_TEST_SUITE_P(RelativePose,
                         EachDepth,
                         ::testing::Values(std::pair{true, true},
                                           std::pair{false, true},
                                           std::pair{true, false}));

TEST(RelativePose, UsesThePlaneOfAWall)
{
    SceneRecipe recipe;
    recipe.planar = true;
    recipe.pixel_noise = 0.5;
    recipe.inverse_depth_noise = 0.001;
    const auto scene = make_scene(recipe, 5);
    const auto pose = estimate(scene);
    ASSERT_TRUE(pose.candidate_from_query) << to_word(pose.reason);
    EXPECT_LT(nees_of(pose, scene.candidate_from_query), 22.458);
}

TEST(RelativePose, IsMoreCertainWithDepthsInBothFrames)
{
    SceneRecipe recipe;
    recipe.pixel_noise = 0.7;
    recipe.inverse_depth_noise = 0.002;
    const auto both = estimate(make_scene(recipe, 6));
    recipe.query_depth = false;
    const auto one = estimate(make_scene(recipe, 6));
    ASSERT_TRUE(both.candidate_from_query && one.candidate_from_query);
    EXPECT_LT(both.candidate_from_query->covariance(2, 2),
              one.candidate_from_query->covariance(2, 2));
}

TEST(RelativePose, MeasuresDepthNoiseThatWasDeclaredWrongly)
{
    SceneRecipe recipe;
    recipe.pixel_noise = 0.3;
    recipe.inverse_depth_noise = 0.004;
    auto scene = make_scene(recipe, 7);
    for (auto* depths : {&scene.query_depths, &scene.candidate_depths})
        for (auto& deviation : depths->deviations_m) deviation /= 2;
    EXPECT_NEAR(estimate(scene).depth_deviation_factor, 2, 0.5);
}

TEST(RelativePose, AddsTheErrorOfTheScaleAlongTheTranslation)
{
    SceneRecipe recipe;
    recipe.query_depth = false;
    auto scene = make_scene(recipe, 8);
    scene.candidate_depths.source = DepthSource::motion;
    scene.candidate_depths.scale_deviation = 0.05;
    const auto pose = estimate(scene);
    ASSERT_TRUE(pose.candidate_from_query);
    const auto& t = pose.candidate_from_query->b_from_a.translation;
    const auto along = cv::normalize(t);
    const auto& c = pose.candidate_from_query->covariance;
    const cv::Matx33d position(
        c(0, 0), c(0, 1), c(0, 2), c(1, 0), c(1, 1), c(1, 2), c(2, 0), c(2, 1), c(2, 2));
    EXPECT_NEAR(std::sqrt(along.dot(position * along)), 0.05 * cv::norm(t), 0.002);
}

TEST(RelativePose, WithoutDepthHasRotationAndDirectionOnly)
{
    SceneRecipe recipe;
    recipe.query_depth = recipe.candidate_depth = false;
    recipe.pixel_noise = 0.3;
    recipe.outliers = 20;
    const auto scene = make_scene(recipe, 9);
    const auto pose = estimate(scene);
    EXPECT_EQ(pose.reason, NoMetricPose::no_depth);
    EXPECT_FALSE(pose.candidate_from_query);
    ASSERT_TRUE(pose.candidate_from_query_unscaled);
    const auto& found = *pose.candidate_from_query_unscaled;
    const auto& truth = scene.candidate_from_query;
    EXPECT_NEAR(cv::norm(found.translation), 1, 1e-9);
    EXPECT_GT(found.translation.dot(cv::normalize(truth.translation)), std::cos(0.05));
    EXPECT_LT(cv::norm(fild::vector_from_rotation(found.rotation.t() * truth.rotation)), 0.01);
}

TEST(RelativePose, SaysWhyThereIsNone)
{
    const auto reason_of = [](const SceneRecipe& recipe)
    { return estimate(make_scene(recipe, 10)).reason; };
    SceneRecipe recipe;
    recipe.points = 0;
    EXPECT_EQ(reason_of(recipe), NoMetricPose::no_depth);
    recipe.points = 11;
    EXPECT_EQ(reason_of(recipe), NoMetricPose::too_few_points);
    recipe.points = 20;
    recipe.outliers = 60;
    EXPECT_EQ(reason_of(recipe), NoMetricPose::disagreement);

    auto scene = make_scene({}, 11);
    scene.camera.reset();
    EXPECT_EQ(estimate(scene).reason, NoMetricPose::not_calibrated);

    scene = make_scene({}, 12);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (auto* depths : {&scene.query_depths, &scene.candidate_depths})
        std::fill(depths->metres.begin(), depths->metres.end(), nan);
    EXPECT_EQ(estimate(scene).reason, NoMetricPose::no_depth);
}

TEST(RelativePose, IsWithheldWhereThePointsDoNotFixIt)
{
    // On a line in space the camera may turn about that line.
    Scene on_a_line;
    Dice dice(13);
    for (int i = 0; i < 60; ++i)
    {
        const cv::Vec3d point(-2 + 4 * i / 60.0, 0.3, 6);
        SceneRecipe recipe;
        recipe.pixel_noise = 0.3;
        recipe.inverse_depth_noise = 0.01;
        add_measurement(point, recipe, dice, on_a_line.candidate, on_a_line.candidate_depths);
        add_measurement(point, recipe, dice, on_a_line.query, on_a_line.query_depths);
        on_a_line.matches.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(i), 0});
    }
    on_a_line.query_depths.source = on_a_line.candidate_depths.source = DepthSource::stereo;
    const auto line = estimate(on_a_line).reason;
    EXPECT_TRUE(line == NoMetricPose::degenerate || line == NoMetricPose::no_model)
        << to_word(line);

    auto one_pixel = make_scene({}, 14);
    std::fill(one_pixel.query.begin(), one_pixel.query.end(), fild::PixelPosition{5, 5});
    std::fill(one_pixel.candidate.begin(), one_pixel.candidate.end(), fild::PixelPosition{7, 7});
    EXPECT_FALSE(estimate(one_pixel).candidate_from_query);
}

TEST(RelativePose, OfOneImageWithItselfIsTheIdentity)
{
    auto scene = make_scene({}, 15);
    scene.query = scene.candidate;
    scene.query_depths = scene.candidate_depths;
    const auto pose = estimate(scene);
    ASSERT_TRUE(pose.candidate_from_query) << to_word(pose.reason);
    EXPECT_LT(cv::norm(error_of(pose.candidate_from_query->b_from_a, {})), 1e-6);
}

TEST(RelativePose, SurvivesPixelsThatAreNoNumbers)
{
    auto scene = make_scene({}, 16);
    for (auto& pixel : scene.query) pixel.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(estimate(scene).candidate_from_query);
}

TEST(RelativePose, RepeatsWithTheSeed)
{
    SceneRecipe recipe;
    recipe.pixel_noise = 1;
    recipe.outliers = 60;
    const auto scene = make_scene(recipe, 17);
    const auto a = estimate(scene);
    const auto b = estimate(scene);
    ASSERT_TRUE(a.candidate_from_query && b.candidate_from_query);
    EXPECT_EQ(a.candidate_from_query->covariance, b.candidate_from_query->covariance);
    EXPECT_EQ(a.candidate_from_query->b_from_a.translation,
              b.candidate_from_query->b_from_a.translation);
}

TEST(RelativePose, RefusesWhatDoesNotFitTogether)
{
    const RelativePoseEstimator estimator({}, 1);
    auto scene = make_scene({}, 18);
    scene.matches.push_back({scene.query.size(), 0, 0});
    EXPECT_THROW(estimate(scene), std::invalid_argument);
    scene = make_scene({}, 18);
    scene.query_depths.metres.pop_back();
    EXPECT_THROW(estimate(scene), std::invalid_argument);
    scene = make_scene({}, 18);
    scene.camera->lens = fild::LensModel::plumb_bob;
    EXPECT_THROW(estimate(scene), std::invalid_argument);
    TRelativePoseOptions options;
    options.min_points = 3;
    EXPECT_THROW(RelativePoseEstimator(options, 1), std::invalid_argument);
}

/** The residual's derivative by central differences of its value. */
cv::Matx<double, 3, 6> numeric_jacobian(const fild::MeasuredMatch& match,
                                        const fild::PinholePair& cameras,
                                        const RigidTransform& pose)
{
    constexpr double kStep = 1e-6;
    cv::Matx<double, 3, 6> jacobian;
    for (int i = 0; i < 6; ++i)
    {
        const auto at = [&](double step)
        {
            auto moved = pose;
            cv::Vec3d change;
            change[i % 3] = step;
            if (i < 3)
                moved.translation += change;
            else
                moved.rotation = pose.rotation * fild::rotation_from_vector(change);
            return fild::pose_residual(match, cameras, moved)->value;
        };
        const cv::Vec3d derivative = (at(kStep) - at(-kStep)) * (0.5 / kStep);
        for (int row = 0; row < 3; ++row) jacobian(row, i) = derivative[row];
    }
    return jacobian;
}

class EachResidual : public ::testing::TestWithParam<std::pair<bool, bool>>
{
 protected:
    static fild::MeasuredMatch match()
    {
        fild::MeasuredMatch match{{{400, 170}}, {{350, 210}}};
        if (GetParam().first) match.query = {{400, 170}, 1 / 5.2, 0.003};
        if (GetParam().second) match.candidate = {{350, 210}, 1 / 6.1, 0.002};
        return match;
    }
    const fild::PinholePair cameras_{pinhole_camera(), pinhole_camera()};
    const RigidTransform pose_{fild::rotation_from_vector({0.1, -0.2, 0.05}), {0.4, -0.2, 0.9}};
};

TEST_P(EachResidual, HasTheDerivativeOfItsValue)
{
    const auto residual = fild::pose_residual(match(), cameras_, pose_);
    ASSERT_TRUE(residual);
    const auto numeric = numeric_jacobian(match(), cameras_, pose_);
    EXPECT_LT(cv::norm(residual->jacobian - numeric, cv::NORM_INF),
              1e-6 * cv::norm(numeric, cv::NORM_INF));
}

TEST_P(EachResidual, HasTheCovarianceOfItsNoise)
{
    Dice dice(1);
    const auto residual = fild::pose_residual(match(), cameras_, pose_);
    constexpr int kTrials = 20000;
    constexpr double kPixelNoise = 0.4;
    cv::Matx33d measured = cv::Matx33d::zeros();
    for (int trial = 0; trial < kTrials; ++trial)
    {
        auto noisy = match();
        for (auto* point : {&noisy.query, &noisy.candidate})
        {
            point->pixel.x += static_cast<float>(dice.normal(kPixelNoise));
            point->pixel.y += static_cast<float>(dice.normal(kPixelNoise));
            if (point->has_depth())
                point->inverse_depth += dice.normal(point->inverse_depth_deviation);
        }
        const cv::Vec3d change =
            fild::pose_residual(noisy, cameras_, pose_)->value - residual->value;
        measured += (1.0 / kTrials) * (change * change.t());
    }
    const cv::Matx33d expected =
        kPixelNoise * kPixelNoise * residual->pixel_part + residual->depth_part;
    const int equations = residual->has_depth_equation ? 3 : 2;
    for (int i = 0; i < equations; ++i)
        for (int k = 0; k < equations; ++k)
            EXPECT_NEAR(
                measured(i, k), expected(i, k), 0.05 * std::sqrt(expected(i, i) * expected(k, k)))
                << i << " " << k;
}

INSTANTIATE_TEST_SUITE_P(PoseResidual,
                         EachResidual,
                         ::testing::Values(std::pair{true, true},
                                           std::pair{false, true},
                                           std::pair{true, false}));

TEST(PoseResidual, IsNoneBehindTheCamera)
{
    const fild::MeasuredMatch match{{{400, 170}}, {{350, 210}, 0.2, 0.01}};
    EXPECT_FALSE(fild::pose_residual(
        match, {pinhole_camera(), pinhole_camera()}, {cv::Matx33d::eye(), {0, 0, 10}}));
}

}  // namespace
