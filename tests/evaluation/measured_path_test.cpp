// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/measured_path.h"

#include "drawn_truth.h"
#include "fild/evaluation/ground_truth.h"
#include "message_of.h"

#include <cmath>

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;

fild::TimedPose pose_at(double seconds, double x, double y, double yaw = 0)
{
    fild::TimedPose timed;
    timed.timestamp = seconds;
    timed.pose.position = {x, y, 0};
    timed.pose.rotation = fild::rotation_of({0, 0, std::sin(yaw / 2), std::cos(yaw / 2)});
    return timed;
}

std::vector<fild::PosedFrame> along(std::vector<fild::TimedPose> poses,
                                    bool oriented,
                                    const std::vector<double>& times)
{
    std::vector<fild::FrameVerdict> frames(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) frames[i].timestamp = times[i];
    return fild::poses_along({std::move(poses), oriented}, frames);
}

double yaw_of(const fild::PosedFrame& frame)
{
    return std::atan2(frame.pose.value().rotation(1, 0), frame.pose.value().rotation(0, 0));
}

TEST(PosesAlong, AreInterpolatedInTime)
{
    const auto frames = along({pose_at(0, 0, 0, 3), pose_at(4, 8, 4, -3)}, true, {1, 4});
    EXPECT_NEAR(cv::norm(frames[0].pose->position - cv::Vec3d(2, 1, 0)), 0, 1e-12);
    // From 3 to -3 rad the short way is over pi: a quarter of 2 pi - 6.
    EXPECT_NEAR(yaw_of(frames[0]), 3 + (2 * kPi - 6) / 4, 1e-9);
    EXPECT_NEAR(frames[1].pose->position[0], 8, 1e-12);
    EXPECT_DOUBLE_EQ(frames[0].timestamp, 1);
}

TEST(PosesAlong, AreUnknownOutsideAndInGaps)
{
    const auto frames = along(
        {pose_at(0, 0, 0), pose_at(4, 8, 4), pose_at(10, 9, 9)}, true, {-0.01, -1, 4.5, 10.01, 11});
    EXPECT_TRUE(frames[0].pose);
    EXPECT_FALSE(frames[1].pose);
    EXPECT_FALSE(frames[2].pose);
    EXPECT_TRUE(frames[3].pose);
    EXPECT_FALSE(frames[4].pose);
    EXPECT_FALSE(along({}, true, {0})[0].pose);
}

// North for four seconds, then west.
TEST(PosesAlong, WithoutOrientationTakeTheDirectionOfMotion)
{
    const auto frames = along({pose_at(0, 0, 0),
                               pose_at(2, 0, 4),
                               pose_at(4, 0, 8),
                               pose_at(6, -4, 8),
                               pose_at(8, -8, 8)},
                              false,
                              {0, 2, 4, 7});
    EXPECT_NEAR(yaw_of(frames[0]), kPi / 2, 1e-9);
    EXPECT_NEAR(yaw_of(frames[1]), kPi / 2, 1e-9);
    EXPECT_NEAR(yaw_of(frames[2]), kPi * 3 / 4, 1e-9);
    EXPECT_NEAR(std::abs(yaw_of(frames[3])), kPi, 1e-9);
    EXPECT_NEAR(frames[3].pose->position[0], -6, 1e-12);
}

TEST(PosesAlong, WithoutOrientationAreUnknownStandingStill)
{
    const auto frames =
        along({pose_at(0, 0, 0), pose_at(5, 0.4, 0), pose_at(10, 9, 0)}, false, {2, 8});
    EXPECT_FALSE(frames[0].pose);
    EXPECT_TRUE(frames[1].pose);
}

// There and back by GPS: the same place, looked at in the other direction; then there again.
TEST(PosesAlong, ByGpsAreTruthUnderARadius)
{
    std::vector<fild::TimedPose> poses;
    for (int i = 0; i <= 60; ++i)
    {
        const int phase = i % 40;
        poses.push_back(pose_at(i, 2 * (phase <= 20 ? phase : 40 - phase), 0));
    }
    const auto frames = fild::testing::frames_at_one_hertz(61);
    const auto truth =
        fild::ground_truth_of(fild::true_poses_along({poses, false}, "GPS 'G'", frames),
                              fild::parse_protocol("radius:3"));
    EXPECT_EQ(truth.content, "GPS 'G' of 59 frames");  // two turning points have no heading
    EXPECT_FALSE(truth.poses->oriented);
    EXPECT_EQ(truth.truth->judge(fild::FrameId{50}, fild::FrameId{10}), fild::Judgement::right);
    EXPECT_EQ(truth.truth->judge(fild::FrameId{50}, fild::FrameId{30}), fild::Judgement::wrong);
    EXPECT_EQ(truth.truth->judge(fild::FrameId{20}, fild::FrameId{10}), fild::Judgement::neither);
    EXPECT_TRUE(truth.truth->is_loop_query(fild::FrameId{50}));
    EXPECT_FALSE(truth.truth->is_loop_query(fild::FrameId{38}));
}

TEST(PosesAlong, OfAnotherTimeAreRefused)
{
    EXPECT_THAT(message_of<std::runtime_error>(
                    []
                    {
                        fild::true_poses_along({{pose_at(100, 0, 0), pose_at(101, 1, 0)}, true},
                                               "GPS 'G'",
                                               fild::testing::frames_at_one_hertz(3));
                    }),
                HasSubstr("GPS 'G'"));
}

TEST(PosesAlong, NeedARadius)
{
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] { fild::ground_truth_of({}, fild::parse_protocol("exact")); }),
                HasSubstr("radius:R"));
}

}  // namespace
