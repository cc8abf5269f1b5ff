// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/node_loops.h"

#include "wall_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <functional>
#include <stdexcept>

namespace
{
using fild::NodeId;
using fild::NodeLoop;
using fild::NodeLoops;
using fild::to_index;
using fild::testing::kWallDrop;
using fild::testing::kWallFramesPerLap;
using fild::testing::kWallShift;
using fild::testing::kWallStep;
using ::testing::ElementsAre;
using ::testing::Pair;

fild::TLoopClosureStreamOptions stream_options()
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("wall.ini"), fild::testing::kWallConfig);
    return fild::load_stream_options(folder.path("wall.ini"));
}

/** Two laps with a reading each quarter of a second and a node so long after each frame. */
struct Drive
{
    double node_delay = 0.25;
    std::function<double(double)> odometry = fild::testing::wall_position;
    bool has_odometry = true;

    std::vector<NodeLoop> through(NodeLoops& loops) const
    {
        std::vector<NodeLoop> found;
        for (std::size_t quarter = 0; quarter < 8 * kWallFramesPerLap; ++quarter)
        {
            const double now = static_cast<double>(quarter) / 4;
            if (has_odometry) loops.feed(*fild::testing::wall_odometry(now, odometry(now)));
            if (quarter % 4 == 0) loops.feed(*fild::testing::wall_scan(quarter / 4));
            if (std::fmod(now, 1) == node_delay) loops.add_node(NodeId{quarter / 4 + 100}, now);
            for (const auto& loop : loops.take_settled()) found.push_back(loop);
        }
        return found;
    }
};

double trace(const NodeLoop& loop)
{
    double sum = 0;
    for (int k = 0; k < 6; ++k) sum += loop.motion.covariance(k, k);
    return sum;
}

TEST(NodeLoopsTest, LeadFromNodeToNodeAlongTheOdometry)
{
    NodeLoops loops(stream_options(), fild::TGraphOptions());
    const auto found = Drive().through(loops);
    ASSERT_EQ(found.size(), kWallFramesPerLap);
    for (const auto& loop : found)
    {
        EXPECT_EQ(to_index(loop.query), to_index(loop.candidate) + kWallFramesPerLap);
        EXPECT_EQ(static_cast<std::uint64_t>(loop.query_node), to_index(loop.query) + 100);
        EXPECT_EQ(static_cast<std::uint64_t>(loop.candidate_node), to_index(loop.candidate) + 100);
        // The last frame of the first lap has a node on the way back.
        const double way = to_index(loop.candidate) + 1 == kWallFramesPerLap
                               ? kWallShift + (0.25 + 7 * 0.25) * kWallStep
                               : kWallShift;
        EXPECT_NEAR(loop.motion.a_from_b.x(), way, 0.03);
        EXPECT_NEAR(loop.motion.a_from_b.y(), 0, 0.05);
        EXPECT_NEAR(loop.motion.a_from_b.z(), -kWallDrop, 0.03);
    }
    EXPECT_EQ(loops.report().loop_closures, kWallFramesPerLap);
    EXPECT_TRUE(loops.report().withheld.empty());
}

TEST(NodeLoopsTest, AreNoLessCertainWhereNodesStandAtFrames)
{
    NodeLoops beside(stream_options(), fild::TGraphOptions());
    NodeLoops at_frames(stream_options(), fild::TGraphOptions());
    const auto with_way = Drive().through(beside);
    Drive drive;
    drive.node_delay = 0;
    auto alone = drive.through(at_frames);
    ASSERT_EQ(alone.size(), with_way.size());
    for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_LT(trace(alone[i]), trace(with_way[i]));
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            EXPECT_EQ(with_way[0].motion.covariance(row, column),
                      with_way[0].motion.covariance(column, row));
}

TEST(NodeLoopsTest, WaitForTheNodeAfterTheQuery)
{
    NodeLoops loops(stream_options(), fild::TGraphOptions());
    for (std::size_t i = 0; i <= kWallFramesPerLap; ++i)
    {
        const auto now = static_cast<double>(i);
        loops.feed(*fild::testing::wall_odometry(now, fild::testing::wall_position(now)));
        if (i < 2) loops.add_node(NodeId{i}, now);
        loops.feed(*fild::testing::wall_scan(i));
        EXPECT_TRUE(loops.take_settled().empty());
    }
    EXPECT_EQ(loops.report().loop_closures, 1U);
    const auto rest = loops.take_all();
    ASSERT_EQ(rest.size(), 1U);
    EXPECT_EQ(rest[0].query_node, NodeId{1}) << "the last there is";
    EXPECT_NEAR(rest[0].motion.a_from_b.x(), kWallStep, 0.03);
    EXPECT_TRUE(loops.take_all().empty());
}

TEST(NodeLoopsTest, AreNotMadeOfWhatIsNotKnown)
{
    Drive drive;
    drive.has_odometry = false;
    NodeLoops no_way(stream_options(), fild::TGraphOptions());
    EXPECT_TRUE(drive.through(no_way).empty());
    EXPECT_THAT(no_way.report().withheld,
                ElementsAre(Pair("frame_without_pose", kWallFramesPerLap)));
    drive.node_delay = 0;
    NodeLoops no_way_needed(stream_options(), fild::TGraphOptions());
    EXPECT_EQ(drive.through(no_way_needed).size(), kWallFramesPerLap);

    NodeLoops no_nodes(stream_options(), fild::TGraphOptions());
    drive.node_delay = -1;
    EXPECT_TRUE(drive.through(no_nodes).empty());
    EXPECT_TRUE(no_nodes.take_all().empty());
    EXPECT_THAT(no_nodes.report().withheld, ElementsAre(Pair("same_node", kWallFramesPerLap)));
}

TEST(NodeLoopsTest, AreLeftOutWhenTheOdometryRulesThemOut)
{
    Drive drive;
    drive.odometry = [](double seconds) { return kWallStep * seconds; };  // never came back
    NodeLoops loops(stream_options(), fild::TGraphOptions());
    EXPECT_TRUE(drive.through(loops).empty());
    EXPECT_THAT(loops.report().withheld, ElementsAre(Pair("against_odometry", kWallFramesPerLap)));
    auto trusting = fild::TGraphOptions();
    trusting.odometry_confidence = 1;
    NodeLoops all(stream_options(), trusting);
    EXPECT_EQ(drive.through(all).size(), kWallFramesPerLap);
}

TEST(NodeLoopsTest, OfASingleCameraAreCountedAndNoEdges)
{
    NodeLoops loops(stream_options(), fild::TGraphOptions());
    for (std::size_t i = 0; i < 2 * kWallFramesPerLap; ++i)
    {
        const auto scan = fild::testing::wall_scan(i);
        mrpt::obs::CObservationImage image;
        image.image = scan->intensityImage;
        image.cameraParams = scan->cameraParamsIntensity;
        image.timestamp = scan->timestamp;
        loops.feed(image);
        loops.add_node(NodeId{i}, static_cast<double>(i));
        EXPECT_TRUE(loops.take_settled().empty());
    }
    EXPECT_THAT(loops.report().withheld, ElementsAre(Pair("no_depth", kWallFramesPerLap)));
}

TEST(NodeLoopsTest, NeedMetricPoses)
{
    auto options = stream_options();
    options.detector.relative_pose.enabled = false;
    EXPECT_THROW(NodeLoops(options, fild::TGraphOptions()), std::invalid_argument);
}

}  // namespace
