// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/frame_poses.h"

#include "drawn_truth.h"
#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::frames_at_one_hertz;
using fild::testing::message_of;
using ::testing::HasSubstr;

constexpr double kQuarterTurn = 1.5707963267948966;

class Poses : public ::testing::Test
{
 protected:
    std::string write(const std::string& text) const
    {
        fild::testing::write_text(folder_.path("poses.txt"), text);
        return folder_.path("poses.txt");
    }

    std::vector<fild::PosedFrame> kitti(const std::string& text, std::size_t frames) const
    {
        return fild::read_kitti_poses(write(text), frames_at_one_hertz(frames));
    }

    std::vector<fild::PosedFrame> tum(const std::string& text, std::size_t frames) const
    {
        return fild::read_tum_poses(write(text), frames_at_one_hertz(frames)).frames;
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

TEST_F(Poses, OfKitti)
{
    const auto frames = kitti("1 0 0 7 0 1 0 8 0 0 1 9\n0 0 1 0 0 1 0 0 -1 0 0 0\n", 2);
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].pose->position, cv::Vec3d(7, 8, 9));
    EXPECT_DOUBLE_EQ(frames[1].timestamp, 1);
    EXPECT_NEAR(fild::angle_between(*frames[0].pose, *frames[1].pose), kQuarterTurn, 1e-9);
}

TEST_F(Poses, OfKittiMustBeAsManyAsFrames)
{
    EXPECT_THAT(message_of<std::runtime_error>([&] { kitti("1 0 0 7 0 1 0 8 0 0 1 9\n", 3); }),
                HasSubstr("1 frame, the run has 3"));
}

TEST_F(Poses, OfKittiMustBeRotations)
{
    EXPECT_THAT(message_of<std::runtime_error>([&] { kitti("2 0 0 7 0 1 0 8 0 0 1 9\n", 1); }),
                HasSubstr("no rotation"));
    EXPECT_THAT(message_of<std::runtime_error>([&] { kitti("1 0 0 7 0 1 0 8\n", 1); }),
                HasSubstr("12 are expected"));
}

TEST_F(Poses, OfTumWithALineForEachFrame)
{
    const auto frames = tum("100 1 2 3 0 0 0 1\n101 4 5 6 0 0 0.70710678 0.70710678\n", 2);
    EXPECT_EQ(frames[0].pose->position, cv::Vec3d(1, 2, 3));
    EXPECT_EQ(frames[1].pose->position, cv::Vec3d(4, 5, 6));
    EXPECT_NEAR(frames[1].pose->rotation(1, 0), 1, 1e-6);  // x turns to y
    EXPECT_NEAR(fild::angle_between(*frames[0].pose, *frames[1].pose), kQuarterTurn, 1e-6);
}

TEST_F(Poses, OfTumByTime)
{
    const auto frames =
        tum("2.01 3 0 0 0 0 0 1\n0.985 1 0 0 0 0 0 1\n1.01 2 0 0 0 0 0 1\n3.03 4 0 0 0 0 0 1\n", 5);
    EXPECT_FALSE(frames[0].pose);
    EXPECT_EQ(frames[1].pose->position[0], 2);  // 10 ms later, not 15 ms earlier
    EXPECT_EQ(frames[2].pose->position[0], 3);
    EXPECT_FALSE(frames[3].pose);  // 30 ms are too much
    EXPECT_FALSE(frames[4].pose);
}

TEST_F(Poses, OfTumAreFoundByTimeEvenWhenThereAreAsManyAsFrames)
{
    const auto reversed = tum("2 7 0 0 0 0 0 1\n1 6 0 0 0 0 0 1\n0 5 0 0 0 0 0 1\n", 3);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(reversed[i].pose->position[0], 5 + static_cast<double>(i));
    const auto shifted = tum("1 6 0 0 0 0 0 1\n2 7 0 0 0 0 0 1\n3 8 0 0 0 0 0 1\n", 3);
    EXPECT_FALSE(shifted[0].pose);
    EXPECT_EQ(shifted[2].pose->position[0], 7);
}

TEST_F(Poses, OfTumOfAnotherClockAreTakenLineByLineAndSaySo)
{
    const auto file = write("7200 5 0 0 0 0 0 1\n7201 6 0 0 0 0 0 1\n");
    const auto poses = fild::read_tum_poses(file, frames_at_one_hertz(2));
    EXPECT_EQ(poses.frames[1].pose->position[0], 6);
    EXPECT_DOUBLE_EQ(poses.seconds_off, 7200);
    EXPECT_THAT(
        message_of<std::runtime_error>([&] { tum("7201 5 0 0 0 0 0 1\n7200 6 0 0 0 0 0 1\n", 2); }),
        HasSubstr("before that of the line above"));
}

TEST_F(Poses, MayBeRounded)
{
    EXPECT_NEAR(tum("0 1 2 3 0 0 0.7 0.7\n", 1)[0].pose->rotation(1, 0), 1, 1e-9);
    const auto eighth_turn = kitti("0.71 -0.71 0 7 0.71 0.71 0 8 0 0 1 9\n", 1)[0].pose;
    EXPECT_NEAR(cv::norm(eighth_turn->rotation.t() * eighth_turn->rotation), std::sqrt(3), 1e-9);
    EXPECT_NEAR(eighth_turn->rotation(0, 0), std::sqrt(0.5), 1e-9);
    EXPECT_THAT(message_of<std::runtime_error>([&] { tum("0 1 2 3 0.9 0 0 0.9\n", 1); }),
                HasSubstr("quaternion"));
    EXPECT_THAT(message_of<std::runtime_error>([&] { kitti("1 0 0 7 0 1 0 8 0 0 -1 9\n", 1); }),
                HasSubstr("no rotation"))
        << "a reflection";
}

TEST_F(Poses, OfTumOfAnotherTimeAreRefused)
{
    EXPECT_THAT(message_of<std::runtime_error>([&] { tum("100 1 2 3 0 0 0 1\n", 2); }),
                HasSubstr("no pose"));
    EXPECT_THAT(message_of<std::runtime_error>([&] { tum("0 1 2 3 0 0 0 0\n", 1); }),
                HasSubstr("quaternion"));
}

}  // namespace
