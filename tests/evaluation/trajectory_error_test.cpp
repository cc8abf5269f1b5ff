// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/trajectory_error.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <cmath>

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;

cv::Matx33d turn_about(const cv::Vec3d& axis, double angle)
{
    const cv::Vec3d v = axis / cv::norm(axis) * std::sin(angle / 2);
    return fild::rotation_of({v[0], v[1], v[2], std::cos(angle / 2)});
}

/** A helix: one metre a second along the circle, looking along it. */
std::vector<fild::TimedPose> helix(std::size_t count)
{
    constexpr double kRadius = 20;
    std::vector<fild::TimedPose> poses(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const double angle = static_cast<double>(i) / kRadius;
        poses[i].timestamp = static_cast<double>(i);
        poses[i].pose.position = {
            kRadius * std::sin(angle), kRadius * (1 - std::cos(angle)), 0.1 * angle};
        poses[i].pose.rotation = turn_about({0, 0, 1}, angle);
    }
    return poses;
}

std::vector<fild::PosedFrame> as_truth(const std::vector<fild::TimedPose>& poses)
{
    std::vector<fild::PosedFrame> frames;
    frames.reserve(poses.size());
    for (const auto& [timestamp, pose] : poses) frames.push_back({timestamp, pose});
    return frames;
}

/** The same trajectory in another fixed frame, of another size. */
std::vector<fild::TimedPose> moved(std::vector<fild::TimedPose> poses, double scale)
{
    const auto rotation = turn_about({1, 2, -0.5}, 2.1);
    for (auto& [timestamp, pose] : poses)
    {
        pose.position = scale * (rotation * pose.position) + cv::Vec3d(100, -30, 7);
        pose.rotation = rotation * pose.rotation;
    }
    return poses;
}

fild::TrajectoryErrorOptions options_with(bool align_scale, std::vector<double> steps = {10})
{
    return {align_scale, std::move(steps)};
}

TEST(TrajectoryError, IsNothingWhereTheFixedFrameIsAnother)
{
    const auto truth = helix(100);
    const auto error = fild::trajectory_error(
        moved(truth, 1), as_truth(truth), true, options_with(false, {10, 50}));
    EXPECT_EQ(error.pairs, 100U);
    EXPECT_DOUBLE_EQ(error.scale, 1);
    EXPECT_NEAR(error.ate_rmse, 0, 1e-9);
    ASSERT_EQ(error.steps.size(), 2U);
    EXPECT_DOUBLE_EQ(error.steps[1].length, 50);
    for (const auto& step : error.steps)
    {
        EXPECT_NEAR(step.translation_rmse, 0, 1e-9);
        EXPECT_NEAR(step.rotation_deg_per_m, 0, 1e-5);
    }
}

TEST(TrajectoryError, IsNothingWhereTheBodyIsTurned)
{
    const auto truth = helix(100);
    auto camera = moved(truth, 1);
    for (auto& [timestamp, pose] : camera)
        pose.rotation = pose.rotation * turn_about({1, -1, 1}, 2 * kPi / 3);
    const auto error = fild::trajectory_error(camera, as_truth(truth), true, options_with(false));
    EXPECT_NEAR(error.steps.at(0).translation_rmse, 0, 1e-9);
    EXPECT_NEAR(error.steps[0].rotation_deg_per_m, 0, 1e-5);
}

TEST(TrajectoryError, FindsTheScaleWhenAsked)
{
    const auto truth = helix(100);
    const auto small = moved(truth, 0.25);
    const auto scaled = fild::trajectory_error(small, as_truth(truth), true, options_with(true));
    EXPECT_NEAR(scaled.scale, 4, 1e-9);
    EXPECT_NEAR(scaled.ate_rmse, 0, 1e-9);
    EXPECT_NEAR(scaled.steps.at(0).translation_rmse, 0, 1e-9);
    const auto unscaled = fild::trajectory_error(small, as_truth(truth), true, options_with(false));
    EXPECT_DOUBLE_EQ(unscaled.scale, 1);
    // A quarter as long: three quarters of each straight step are missing.
    EXPECT_NEAR(unscaled.steps.at(0).translation_percent, 75, 1);
    EXPECT_GT(unscaled.ate_rmse, 1);
}

// Four corners of a square of side 2, of which opposite ones are lifted by +1 and lowered by -1:
// no rotation or translation makes that smaller.
TEST(TrajectoryError, IsTheRootMeanSquareByHand)
{
    std::vector<fild::TimedPose> truth(4);
    const std::vector<cv::Vec3d> corners{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
    for (std::size_t i = 0; i < 4; ++i)
    {
        truth[i].timestamp = static_cast<double>(i);
        truth[i].pose.position = corners[i];
    }
    auto bent = truth;
    for (std::size_t i = 0; i < 4; ++i) bent[i].pose.position[2] = i % 2 == 0 ? 0.5 : -0.5;
    const auto error = fild::trajectory_error(bent, as_truth(truth), false, options_with(false));
    EXPECT_NEAR(error.ate_rmse, 0.5, 1e-9);
    EXPECT_TRUE(error.steps.empty());  // no true orientations
}

// 1 % too long and turning 0.5 degrees a metre, on a straight way.
TEST(TrajectoryError, OfStepsIsPerMetre)
{
    std::vector<fild::TimedPose> truth(101);
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
        truth[i].timestamp = static_cast<double>(i);
        truth[i].pose.position = {static_cast<double>(i), 0, 0};
    }
    auto longer = truth;
    for (auto& [timestamp, pose] : longer) pose.position *= 1.01;
    const auto stretched =
        fild::trajectory_error(longer, as_truth(truth), true, options_with(false, {20, 1000}));
    ASSERT_EQ(stretched.steps.size(), 1U);
    EXPECT_EQ(stretched.steps[0].steps, 81U);
    EXPECT_NEAR(stretched.steps[0].translation_rmse, 0.2, 1e-9);
    EXPECT_NEAR(stretched.steps[0].translation_percent, 1, 1e-9);
    EXPECT_NEAR(stretched.steps[0].rotation_deg_per_m, 0, 1e-6);

    auto turning = truth;
    for (auto& [timestamp, pose] : turning)
        pose.rotation = turn_about({0, 0, 1}, pose.position[0] * 0.5 * kPi / 180);
    const auto turned =
        fild::trajectory_error(turning, as_truth(truth), true, options_with(false, {20}));
    EXPECT_NEAR(turned.steps.at(0).rotation_deg_per_m, 0.5, 1e-6);
}

TEST(TrajectoryError, PairsByTime)
{
    auto truth = as_truth(helix(100));
    truth[7].pose.reset();
    auto sparse = helix(100);
    for (auto& pose : sparse) pose.timestamp += 0.01;
    sparse[9].timestamp += 0.5;  // of no frame
    sparse.erase(sparse.begin() + 50, sparse.end());
    const auto error = fild::trajectory_error(sparse, truth, true, options_with(false));
    EXPECT_EQ(error.pairs, 48U);
    EXPECT_NEAR(error.ate_rmse, 0, 1e-9);
}

TEST(TrajectoryError, RefusesNonsense)
{
    const auto truth = as_truth(helix(10));
    auto late = helix(10);
    for (auto& pose : late) pose.timestamp += 8;
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] { fild::trajectory_error(late, truth, true, options_with(false)); }),
                HasSubstr("2 poses"));
    const std::vector<fild::TimedPose> still{{0, {}}, {1, {}}, {2, {}}};
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] { fild::trajectory_error(still, truth, true, options_with(true)); }),
                HasSubstr("does not move"));
    EXPECT_THAT(
        message_of<std::invalid_argument>(
            [&] { fild::trajectory_error(helix(10), truth, true, options_with(false, {0})); }),
        HasSubstr("step length"));
}

TEST(ReadTumTrajectory, SortsByTimeAndRefusesNothing)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("t.tum"), "# path\n2 5 0 0 0 0 0 1\n1 4 0 0 0 0 0 1\n");
    const auto poses = fild::read_tum_trajectory(folder.path("t.tum"));
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_DOUBLE_EQ(poses[0].timestamp, 1);
    EXPECT_DOUBLE_EQ(poses[0].pose.position[0], 4);
    fild::testing::write_text(folder.path("none.tum"), "# path\n");
    EXPECT_THAT(
        message_of<std::runtime_error>([&] { fild::read_tum_trajectory(folder.path("none.tum")); }),
        HasSubstr("none.tum"));
}

}  // namespace
