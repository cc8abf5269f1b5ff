// SPDX-License-Identifier: BSD-3-Clause
// What we write, read back by MRPT's own readers.
#include "fild/graph/graph_files.h"

#include "message_of.h"
#include "observations.h"
#include "random_poses.h"
#include "small_graphs.h"
#include "temporary_folder.h"

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <opencv2/core.hpp>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace
{
using fild::FrameId;
using fild::GraphDimensions;
using fild::PoseGraph;
using fild::testing::graph_of;
using fild::testing::message_of;
using fild::testing::random_information;
using fild::testing::random_pose;
using fild::testing::read_text;
using fild::testing::TemporaryFolder;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;

PoseGraph random_graph()
{
    constexpr double kTilt = 0.8;
    std::mt19937_64 generator(6);
    std::vector<CPose3D> poses;
    poses.reserve(5);
    for (int i = 0; i < 5; ++i) poses.push_back(random_pose(generator, kTilt));
    auto graph = graph_of(poses);
    graph.loops.push_back(
        {FrameId{0}, FrameId{3}, random_pose(generator, kTilt), random_information(generator)});
    for (auto& edge : graph.odometry) edge.information = random_information(generator);
    for (auto& node : graph.nodes) node.frame = FrameId{10 * to_index(node.frame)};
    for (auto* edges : {&graph.odometry, &graph.loops})
        for (auto& edge : *edges)
        {
            edge.a = FrameId{10 * to_index(edge.a)};
            edge.b = FrameId{10 * to_index(edge.b)};
        }
    return graph;
}

template <class Graph>
Graph read_back(const PoseGraph& graph, GraphDimensions dimensions)
{
    const TemporaryFolder folder;
    const auto path = folder.path("poses.graph");
    fild::write_mrpt_graph(path, graph, dimensions);
    Graph read;
    read.loadFromTextFile(path);
    return read;
}

/** The words of the first line that begins so. */
std::vector<double> numbers_of_line(const std::string& path, const std::string& beginning)
{
    std::istringstream text(read_text(path));
    std::string line;
    while (std::getline(text, line) && line.rfind(beginning, 0) != 0)
    {
    }
    std::istringstream words(line.substr(std::min(beginning.size(), line.size())));
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    return numbers;
}

TEST(WriteMrptGraph, In3DIsReadBackByMrpt)
{
    const auto graph = random_graph();
    const auto read =
        read_back<mrpt::graphs::CNetworkOfPoses3DInf>(graph, GraphDimensions::spatial);
    ASSERT_EQ(read.nodes.size(), 5U);
    EXPECT_EQ(read.root, 0U);
    for (const auto& node : graph.nodes)
    {
        const CPose3D& pose = read.nodes.at(to_index(node.frame));
        EXPECT_LT((pose - node.map_from_robot).norm(), 1e-12);
        EXPECT_NEAR(pose.yaw(), node.map_from_robot.yaw(), 1e-12);
    }
    ASSERT_EQ(read.edgeCount(), 5U);
    for (const auto* edges : {&graph.odometry, &graph.loops})
        for (const auto& edge : *edges)
        {
            const auto& found = read.getEdge(to_index(edge.a), to_index(edge.b));
            EXPECT_LT((found.mean - edge.a_from_b).norm(), 1e-12);
            EXPECT_NEAR(found.mean.roll(), edge.a_from_b.roll(), 1e-12);
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j < 6; ++j)
                {
                    if (i != j && i >= 3 && j >= 3) continue;
                    EXPECT_NEAR(found.cov_inv(i, j), edge.information(i, j), 1e-12);
                }
        }
}

// MRPT 2.5's reader loses the terms between two angles (it completes the matrix from the half that
// it did not read), so these are looked up in the file.
TEST(WriteMrptGraph, In3DHasTorosOrder)
{
    const TemporaryFolder folder;
    const auto graph = random_graph();
    fild::write_mrpt_graph(folder.path("poses.graph"), graph, GraphDimensions::spatial);
    const auto numbers = numbers_of_line(folder.path("poses.graph"), "EDGE3 0 30");
    ASSERT_EQ(numbers.size(), 6U + 21U);
    const auto& edge = graph.loops[0];
    EXPECT_EQ(numbers[3], edge.a_from_b.roll());
    EXPECT_EQ(numbers[5], edge.a_from_b.yaw());
    const std::array<int, 6> order{0, 1, 2, 5, 4, 3};
    auto next = numbers.begin() + 6;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = i; j < 6; ++j)
            EXPECT_EQ(*next++, edge.information(order.at(i), order.at(j))) << i << " " << j;
}

// The planar information is the inverse of what MRPT's own projection has as covariance.
TEST(WriteMrptGraph, In2DIsReadBackByMrpt)
{
    const auto graph = random_graph();
    const auto read = read_back<mrpt::graphs::CNetworkOfPoses2DInf>(graph, GraphDimensions::planar);
    ASSERT_EQ(read.nodes.size(), 5U);
    const auto& node = graph.nodes[2];
    EXPECT_NEAR(read.nodes.at(20).x(), node.map_from_robot.x(), 1e-12);
    EXPECT_NEAR(read.nodes.at(20).phi(), node.map_from_robot.yaw(), 1e-12);
    const auto& loop = graph.loops[0];
    const auto& found = read.getEdge(0, 30);
    EXPECT_NEAR(found.mean.y(), loop.a_from_b.y(), 1e-12);
    EXPECT_NEAR(found.mean.phi(), loop.a_from_b.yaw(), 1e-12);
    const auto spatial = loop.information.inverse_LLt();
    const auto planar = found.cov_inv.inverse_LLt();
    const std::array<int, 3> place{0, 1, 3};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(planar(i, j),
                        spatial(place.at(static_cast<std::size_t>(i)),
                                place.at(static_cast<std::size_t>(j))),
                        1e-9);
}

/** g2o's error of an edge: (x y z qx qy qz) of measured^-1 * a_from_b. */
Eigen::Matrix<double, 6, 1> g2o_error(const CPose3D& measured, const CPose3D& a_from_b)
{
    const CPose3D off = a_from_b - measured;
    mrpt::math::CQuaternionDouble turn;
    off.getAsQuaternion(turn);
    const double sign = turn.r() < 0 ? -1 : 1;
    Eigen::Matrix<double, 6, 1> error;
    error << off.x(), off.y(), off.z(), sign * turn.x(), sign * turn.y(), sign * turn.z();
    return error;
}

// A small change of each of MRPT's parameters has the same cost in g2o's terms.
TEST(WriteG2o, InformationIsForTheVectorPartOfTheQuaternion)
{
    constexpr double kStep = 1e-5;
    const TemporaryFolder folder;
    const auto graph = random_graph();
    const auto& loop = graph.loops[0];
    fild::write_g2o(folder.path("poses.g2o"), graph);
    const auto numbers = numbers_of_line(folder.path("poses.g2o"), "EDGE_SE3:QUAT 0 30");
    ASSERT_EQ(numbers.size(), 7U + 21U);
    Eigen::Matrix<double, 6, 6> information;
    auto next = numbers.begin() + 7;
    for (int i = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j) information(i, j) = information(j, i) = *next++;
    const auto& p = loop.a_from_b;
    Eigen::Matrix<double, 6, 6> jacobian;
    for (int i = 0; i < 6; ++i)
    {
        std::array<double, 6> q{p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll()};
        q.at(static_cast<std::size_t>(i)) += kStep;
        jacobian.col(i) = g2o_error(p, CPose3D(q[0], q[1], q[2], q[3], q[4], q[5])) / kStep;
    }
    const Eigen::Matrix<double, 6, 6> in_parameters = jacobian.transpose() * information * jacobian;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            EXPECT_NEAR(in_parameters(i, j), loop.information(i, j), 2e-3) << i << " " << j;
}

TEST(WriteG2o, RotationsCountFourTimesAndCrossTermsTwice)
{
    const TemporaryFolder folder;
    auto graph = graph_of({CPose3D(), CPose3D(1, 0, 0, 0, 0, 0)});
    auto& information = graph.odometry[0].information;
    information.setIdentity();
    information(0, 5) = information(5, 0) = 0.25;  // x and roll
    fild::write_g2o(folder.path("poses.g2o"), graph);
    EXPECT_THAT(numbers_of_line(folder.path("poses.g2o"), "EDGE_SE3:QUAT 0 1"),
                testing::ElementsAre(1,
                                     0,
                                     0,
                                     0,
                                     0,
                                     0,
                                     1,  // x y z qx qy qz qw
                                     1,
                                     0,
                                     0,
                                     0.5,
                                     0,
                                     0,  // x
                                     1,
                                     0,
                                     0,
                                     0,
                                     0,  // y
                                     1,
                                     0,
                                     0,
                                     0,  // z
                                     4,
                                     0,
                                     0,  // qx
                                     4,
                                     0,  // qy
                                     4));  // qz
}

TEST(WriteG2o, PosesAreReadBackByMrpt)
{
    const TemporaryFolder folder;
    const auto graph = random_graph();
    fild::write_g2o(folder.path("poses.g2o"), graph);
    mrpt::graphs::CNetworkOfPoses3DInf read;
    read.loadFromTextFile(folder.path("poses.g2o"));
    for (const auto& node : graph.nodes)
        EXPECT_LT((read.nodes.at(to_index(node.frame)) - node.map_from_robot).norm(), 1e-9);
    EXPECT_LT((read.getEdge(0, 30).mean - graph.loops[0].a_from_b).norm(), 1e-9);
}

// Ceres' and SE-Sync's readers stop at a line that they do not know; g2o itself fixes a node where
// none is fixed. MRPT takes the root from it.
TEST(WriteG2o, HasOnlyTheLinesThatEveryReaderKnows)
{
    const TemporaryFolder folder;
    const auto graph = random_graph();
    fild::write_g2o(folder.path("poses.g2o"), graph);
    std::istringstream text(read_text(folder.path("poses.g2o")));
    for (std::string line; std::getline(text, line);)
        EXPECT_THAT(line.substr(0, line.find(' ')),
                    testing::AnyOf("VERTEX_SE3:QUAT", "EDGE_SE3:QUAT"));
    fild::write_mrpt_graph(folder.path("poses.graph"), graph, GraphDimensions::spatial);
    EXPECT_THAT(read_text(folder.path("poses.graph")), HasSubstr("\nFIX 0\n"));
}

TEST(GraphFiles, WriteNothingOfABadGraph)
{
    const TemporaryFolder folder;
    auto graph = random_graph();
    graph.loops[0].information.setZero();
    EXPECT_THROW(fild::write_g2o(folder.path("a.g2o"), graph), std::invalid_argument);
    EXPECT_THROW(fild::write_mrpt_graph(folder.path("a.graph"), graph, GraphDimensions::spatial),
                 std::invalid_argument);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THAT(message_of<std::runtime_error>(
                    [] { fild::write_g2o("/no/such/folder/a.g2o", random_graph()); }),
                HasSubstr("/no/such/folder/a.g2o"));
}

TEST(WriteSimpleMap, IsReadBackByMrpt)
{
    const TemporaryFolder folder;
    const auto graph = random_graph();
    std::vector<FrameId> asked;
    const auto observations_at = [&](FrameId frame)
    {
        asked.push_back(frame);
        const auto image = mrpt::obs::CObservationImage::Create(
            fild::testing::image_at(static_cast<double>(to_index(frame))));
        image->image.setExternalStorage("left.jpg");
        return std::vector<std::shared_ptr<mrpt::obs::CObservation>>{image};
    };
    fild::write_simple_map(folder.path("map.simplemap"), graph, observations_at);
    EXPECT_EQ(asked.size(), graph.nodes.size());
    mrpt::maps::CSimpleMap map;
    ASSERT_TRUE(map.loadFromFile(folder.path("map.simplemap")));
    ASSERT_EQ(map.size(), graph.nodes.size());
    const auto [pose, frame] = map.get(2);
    EXPECT_LT((pose->getMeanVal() - graph.nodes[2].map_from_robot).norm(), 1e-12);
    const auto image = frame->getObservationByClass<mrpt::obs::CObservationImage>();
    ASSERT_TRUE(image);
    EXPECT_EQ(mrpt::Clock::toDouble(image->timestamp), 20);
    EXPECT_EQ(image->image.getExternalStorageFile(), "left.jpg");
    EXPECT_THROW(fild::write_simple_map("/no/such/folder/map.simplemap", graph, observations_at),
                 std::runtime_error);
}

/** Memory that this process has, bytes. */
std::size_t resident_bytes()
{
    std::ifstream statistics("/proc/self/statm");
    std::size_t pages = 0;
    statistics >> pages >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(WriteSimpleMap, TakesTheMemoryOfOneKeyframeHoweverManyThereAre)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer keeps what was freed";
#endif
    const TemporaryFolder folder;
    const auto graph = graph_of(std::vector<CPose3D>(200));
    constexpr int kSide = 1000;
    constexpr std::size_t kImage = std::size_t{kSide} * kSide;
    std::vector<std::size_t> memory;
    const auto observations_at = [&](FrameId frame)
    {
        const auto image = mrpt::obs::CObservationImage::Create(
            fild::testing::image_at(static_cast<double>(to_index(frame))));
        image->image.resize(kSide, kSide, mrpt::img::CH_GRAY);
        image->image.asCvMatRef().setTo(cv::Scalar::all(static_cast<double>(to_index(frame))));
        memory.push_back(resident_bytes());
        return std::vector<std::shared_ptr<mrpt::obs::CObservation>>{image};
    };
    fild::write_simple_map(folder.path("map.simplemap"), graph, observations_at);
    ASSERT_EQ(memory.size(), graph.nodes.size());
    EXPECT_LT(memory.back(), memory[10] + 20 * kImage);
}

}  // namespace
