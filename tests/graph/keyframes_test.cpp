// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/keyframes.h"

#include "fild/core/angle.h"
#include "fild/mapping/trajectory_builder.h"
#include "message_of.h"
#include "observations.h"

#include <numeric>

namespace
{
using fild::FrameId;
using fild::select_keyframes;
using fild::TGraphOptions;
using fild::Trajectory;
using mrpt::poses::CPose2D;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Trajectory trajectory_of(const std::vector<CPose2D>& poses)
{
    fild::TrajectoryBuilder builder({});
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        const auto seconds = static_cast<double>(i);
        builder.feed(fild::testing::odometry_at(seconds, poses[i]));
        builder.add_frame(FrameId{i}, seconds);
    }
    return builder.build();
}

std::vector<CPose2D> straight_on(int count, double step)
{
    std::vector<CPose2D> poses;
    poses.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) poses.emplace_back(i * step, 0, 0);
    return poses;
}

/** Only this reason. */
TGraphOptions by(double metres, double degrees, double seconds)
{
    TGraphOptions options;
    options.keyframe_distance_m = metres;
    options.keyframe_angle_deg = degrees;
    options.keyframe_seconds = seconds;
    return options;
}

TEST(Keyframes, AreADistanceApart)
{
    EXPECT_THAT(select_keyframes(trajectory_of(straight_on(9, 0.4)), by(1, 0, 0)),
                ElementsAre(FrameId{0}, FrameId{3}, FrameId{6}, FrameId{8}));
}

TEST(Keyframes, AreAnAngleApart)
{
    std::vector<CPose2D> turning;
    turning.reserve(9);
    for (int i = 0; i < 9; ++i) turning.emplace_back(0, 0, i * 4 * fild::kRadiansPerDegree);
    EXPECT_THAT(select_keyframes(trajectory_of(turning), by(0, 11, 0)),
                ElementsAre(FrameId{0}, FrameId{3}, FrameId{6}, FrameId{8}));
}

TEST(Keyframes, AreATimeApart)
{
    EXPECT_THAT(select_keyframes(trajectory_of(straight_on(9, 0)), by(0, 0, 4)),
                ElementsAre(FrameId{0}, FrameId{4}, FrameId{8}));
}

TEST(Keyframes, HaveAllFramesOfLoopsAmongThem)
{
    const auto trajectory = trajectory_of(straight_on(9, 0.4));
    EXPECT_THAT(select_keyframes(trajectory, by(1, 0, 0), {FrameId{4}, FrameId{5}, FrameId{77}}),
                ElementsAre(FrameId{0}, FrameId{3}, FrameId{4}, FrameId{5}, FrameId{8}));
}

TEST(Keyframes, AreTheEndsOfEachSegment)
{
    auto poses = straight_on(4, 0.1);
    poses.emplace_back(500, 0, 0);
    poses.emplace_back(500.1, 0, 0);
    poses.emplace_back(500.2, 0, 0);
    EXPECT_THAT(select_keyframes(trajectory_of(poses), by(100, 0, 0)),
                ElementsAre(FrameId{0}, FrameId{3}, FrameId{4}, FrameId{6}));
}

TEST(Keyframes, OfOneFrameAreOne)
{
    EXPECT_THAT(select_keyframes(trajectory_of(straight_on(1, 1)), {}), SizeIs(1));
    EXPECT_THAT(select_keyframes(trajectory_of({}), {}), IsEmpty());
    EXPECT_THROW(select_keyframes(trajectory_of({}), by(0, 0, 0)), std::invalid_argument);
}

}  // namespace
