// SPDX-License-Identifier: BSD-3-Clause
// The deciders as an engine calls them, node decider first, on a graph of their own.
#include "fild/graphslam/odometry_nrd.h"
#include "fild/graphslam/visual_loop_erd.h"
#include "graph/observations.h"
#include "message_of.h"
#include "wall_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fild::testing::kWallFramesPerLap;
using fild::testing::kWallShift;
using fild::testing::message_of;
using ::testing::HasSubstr;

template <class Graph>
class DecidersTest : public ::testing::Test
{
 protected:
    DecidersTest()
    {
        fild::testing::write_text(folder_.path("fild.ini"), fild::testing::kWallConfig);
        write_engine("registration_max_distance = 1\n");
        nodes_.setGraphPtr(&graph_);
        edges_.setGraphPtr(&graph_);
    }

    void write_engine(const std::string& keys) const
    {
        fild::testing::write_text(engine(),
                                  "[NodeRegistrationDeciderParameters]\nclass_verbosity = 3\n"
                                  "fild_config = fild.ini\n" +
                                      keys +
                                      "[EdgeRegistrationDeciderParameters]\nclass_verbosity = 3\n"
                                      "fild_config = fild.ini\n");
    }

    std::string engine() const { return folder_.path("engine.ini"); }

    void load()
    {
        nodes_.loadParams(engine());
        edges_.loadParams(engine());
    }

    void step(const mrpt::obs::CObservation::Ptr& observation)
    {
        nodes_.updateState({}, {}, observation);
        edges_.updateState({}, {}, observation);
    }

    fild::testing::TemporaryFolder folder_;
    Graph graph_;
    fild::COdometryNRD<Graph> nodes_;
    fild::CVisualLoopERD<Graph> edges_;
};

using Graphs =
    ::testing::Types<mrpt::graphs::CNetworkOfPoses2DInf, mrpt::graphs::CNetworkOfPoses3DInf>;

/** How the two are called in the names of the tests. */
struct GraphName
{
    template <class Graph>
    static std::string GetName(int)
    {
        return Graph::constraint_t::is_3D() ? "3d" : "2d";
    }
};
TYPED_TEST_SUITE(DecidersTest, Graphs, GraphName);

TYPED_TEST(DecidersTest, BuildAGraphWithLoops)
{
    this->load();
    for (std::size_t i = 0; i < 2 * kWallFramesPerLap; ++i)
    {
        const auto now = static_cast<double>(i);
        this->step(fild::testing::wall_odometry(now, fild::testing::wall_position(now)));
        this->step(fild::testing::wall_scan(i));
    }
    EXPECT_EQ(this->graph_.nodeCount(), 2 * kWallFramesPerLap);
    this->edges_.finish();
    std::map<std::string, int> statistics;
    this->edges_.getEdgesStats(&statistics);
    // The first frame of the second lap shows what the root does: its edge goes to node 1.
    EXPECT_EQ(statistics["lc"], static_cast<int>(kWallFramesPerLap));
    EXPECT_EQ(this->edges_.numRegisteredLoops(), kWallFramesPerLap);
    EXPECT_EQ(this->graph_.edgeCount(), 2 * kWallFramesPerLap - 1 + kWallFramesPerLap);
    this->graph_.dijkstra_nodes_estimate();
    for (const auto& [nodes, edge] : this->graph_.edges)
    {
        EXPECT_LT(nodes.first, nodes.second);
        const bool is_loop = nodes.first + 1 != nodes.second;
        if (is_loop && nodes.first > 1)
        {
            EXPECT_NEAR(edge.getMeanVal().x(), kWallShift, 0.03);
        }
        EXPECT_GT(edge.cov_inv.det(), 0);
        EXPECT_TRUE(edge.cov_inv.asEigen().isApprox(edge.cov_inv.asEigen().transpose(), 0));
    }
    const auto& times = this->nodes_.getNodeTimestamps();
    ASSERT_EQ(times.size(), this->graph_.nodeCount());
    for (const auto& [node, time] : times) EXPECT_EQ(time, static_cast<double>(node));
    std::string report;
    this->edges_.getDescriptiveReport(&report);
    EXPECT_THAT(report, HasSubstr("8 edges of 8 loop closures, 16 camera frames"));
}

TYPED_TEST(DecidersTest, TakeActionsAndSensoryFrames)
{
    this->load();
    for (int i = 0; i < 9; ++i)
    {
        const auto actions =
            std::make_shared<mrpt::obs::CActionCollection>(fild::testing::movement_2d({0.6, 0, 0}));
        const auto frame = mrpt::obs::CSensoryFrame::Create();
        frame->insert(
            std::make_shared<mrpt::obs::CObservationImage>(fild::testing::image_at(i + 10)));
        const bool is_new = this->nodes_.updateState(actions, frame, {});
        EXPECT_EQ(is_new, i > 0 && i % 2 == 0) << i;
    }
    ASSERT_EQ(this->graph_.nodeCount(), 5U);
    for (const auto& [nodes, edge] : this->graph_.edges)
        EXPECT_NEAR(edge.getMeanVal().x(), 1.2, 1e-9);
    EXPECT_EQ(this->nodes_.getNodeTimestamps().at(0), 10);
    EXPECT_EQ(this->nodes_.getNodeTimestamps().at(4), 18);
}

TYPED_TEST(DecidersTest, RegisterANodeWhenTheRobotTurns)
{
    this->write_engine("registration_max_angle = 20\n");
    this->load();
    for (int i = 0; i < 10; ++i)
    {
        const auto odometry =
            mrpt::obs::CObservationOdometry::Create(fild::testing::odometry_at(i, {0, 0, 0.2 * i}));
        EXPECT_EQ(this->nodes_.updateState({}, {}, odometry), i > 0 && i % 2 == 0) << i;
    }
    EXPECT_EQ(this->graph_.nodeCount(), 5U);
}

TYPED_TEST(DecidersTest, RefuseWhatCannotBe)
{
    this->write_engine("registration_max_distance = -1\n");
    EXPECT_THAT(message_of<std::exception>([&] { this->nodes_.loadParams(this->engine()); }),
                HasSubstr("registration_max_distance=-1 is not above 0"));
    EXPECT_THROW(this->nodes_.updateState({}, {}, fild::testing::wall_odometry(0, 0)),
                 std::logic_error);
    EXPECT_THROW(this->edges_.updateState({}, {}, fild::testing::wall_odometry(0, 0)),
                 std::logic_error);
    fild::testing::write_text(this->folder_.path("fild.ini"), "[relative_pose]\nenabled = false\n");
    EXPECT_THAT(message_of<std::exception>([&] { this->edges_.loadParams(this->engine()); }),
                HasSubstr("[relative_pose] enabled=false"));
}

}  // namespace
