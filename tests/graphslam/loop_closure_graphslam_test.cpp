// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-graphslam on a small town: with loops the trajectory is better than without.
#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/trajectory_error.h"
#include "run_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <filesystem>
#include <sstream>

namespace
{
using fild::testing::Finished;
using fild::testing::read_text;
using fild::testing::run_command;
using fild::testing::TemporaryFolder;
using fild::testing::write_text;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/** The network tells little, so all earlier frames are candidates. */
constexpr const char* kFildConfig =
    "[global_descriptor]\nmodel_file = " FILD_TINY_NETWORK
    "\nlayers = map\ninput_width = 4\ninput_height = 4\npooling = grid\n"
    "[index]\ndelay_seconds = 20\ncandidates = 60\nsearch_width = 64\n"
    "[hashing]\nratio = 0.87\nmutual_check = true\n"
    "[verification]\nmethod = magsac\nmin_inliers = 40\none_shape = true\n"
    "[consistency]\nconsecutive_frames = 1\n";

constexpr const char* kEngine =
    "[GeneralConfiguration]\nclass_verbosity = 3\n"
    "[NodeRegistrationDeciderParameters]\nclass_verbosity = 3\nfild_config = fild.ini\n"
    "registration_max_distance = 1\n"
    "[EdgeRegistrationDeciderParameters]\nclass_verbosity = 3\nfild_config = fild.ini\n"
    "[OptimizerParameters]\nclass_verbosity = 3\n";

struct Counts
{
    std::size_t nodes = 0;
    std::size_t odometry_edges = 0;
    std::size_t loop_edges = 0;
};

class LoopClosureGraphslam : public ::testing::Test
{
 protected:
    LoopClosureGraphslam()
    {
        write_text(path("fild.ini"), kFildConfig);
        write_text(path("engine.ini"), kEngine);
    }

    std::string path(const std::string& name) const { return folder_.path(name); }

    void draw(const std::string& more) const
    {
        const auto finished =
            run_command("'" SYNTHETIC_RAWLOG "' --preset tiny --quiet --output '" +
                        path("town.rawlog") + "' " + more);
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
    }

    Finished run(const std::string& more) const
    {
        return run_command("env -u DISPLAY '" LOOP_CLOSURE_GRAPHSLAM "' --quiet --rawlog '" +
                           path("town.rawlog") + "' --config '" + path("engine.ini") +
                           "' --output '" + path("out") + "' " + more);
    }

    Counts run_well(const std::string& more) const
    {
        const auto finished = run(more);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_EQ(finished.err, "");
        Counts counts;
        std::string word;
        std::istringstream text(finished.out);
        text >> counts.nodes >> word >> counts.odometry_edges >> word >> word >> counts.loop_edges;
        EXPECT_THAT(finished.out, HasSubstr(" loop edges, in ")) << "first of all";
        return counts;
    }

    /** Absolute trajectory error, metres. */
    double error() const
    {
        const auto truth = fild::read_tum_trajectory(path("town.gt.tum"));
        std::vector<fild::PosedFrame> frames;
        frames.reserve(truth.size());
        for (const auto& pose : truth) frames.push_back({pose.timestamp, pose.pose});
        return trajectory_error(fild::read_tum_trajectory(path("out/trajectory.tum")),
                                frames,
                                true,
                                fild::TrajectoryErrorOptions())
            .ate_rmse;
    }

    /** Of the edges in poses.graph; MRPT's reader loses what stands between the angles in 3D. */
    std::vector<Eigen::MatrixXd> informations() const
    {
        std::vector<Eigen::MatrixXd> all;
        std::istringstream file(read_text(path("out/poses.graph")));
        for (std::string line; std::getline(file, line);)
        {
            std::istringstream words(line);
            std::string key;
            words >> key;
            if (key.rfind("EDGE", 0) != 0) continue;
            const int size = key == "EDGE3" ? 6 : 3;
            double number = 0;
            for (int i = 0; i < 2 + size; ++i) words >> number;  // nodes and pose
            all.emplace_back(size, size);
            for (int row = 0; row < size; ++row)
                for (int column = row; column < size; ++column)
                {
                    EXPECT_TRUE(words >> number);
                    all.back()(row, column) = all.back()(column, row) = number;
                }
        }
        return all;
    }

    /** Runs with loops and without. */
    template <class Graph>
    void expect_loops_to_help(const std::string& more) const
    {
        const auto without = run_well("--no-loops " + more);
        EXPECT_EQ(without.loop_edges, 0U);
        const double error_without = error();
        const auto with = run_well(more);
        EXPECT_EQ(with.nodes, without.nodes);
        EXPECT_EQ(with.odometry_edges, with.nodes - 1);
        EXPECT_GE(with.loop_edges, 8U);
        EXPECT_LT(error(), 0.9 * error_without);
        RecordProperty("error_without", std::to_string(error_without));
        RecordProperty("error_with", std::to_string(error()));
        Graph graph;
        graph.loadFromTextFile(path("out/poses.graph"), false);
        EXPECT_EQ(graph.nodeCount(), with.nodes);
        EXPECT_EQ(graph.edgeCount(), with.odometry_edges + with.loop_edges);
        for (const auto& information : informations())
            EXPECT_EQ(information.llt().info(), Eigen::Success);
    }

    void expect_error(const std::string& more, int exit_code, const std::string& message) const
    {
        const auto finished = run(more);
        EXPECT_EQ(finished.exit_code, exit_code);
        EXPECT_THAT(finished.err, StartsWith("loop-closure-graphslam: "));
        EXPECT_THAT(finished.err, HasSubstr(message));
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
        EXPECT_FALSE(fs::exists(path("out/poses.graph")));
    }

 private:
    TemporaryFolder folder_;
};

TEST_F(LoopClosureGraphslam, MakesTheTrajectoryBetterIn3dAndIn2d)
{
    draw("");
    expect_loops_to_help<mrpt::graphs::CNetworkOfPoses3DInf>("");
    expect_loops_to_help<mrpt::graphs::CNetworkOfPoses2DInf>("--dimensions 2d");
}

TEST_F(LoopClosureGraphslam, TakesDepthImagesAndPosesInSixDimensions)
{
    draw("--sensor rgbd --set sensors.odometry=robot_pose");
    expect_loops_to_help<mrpt::graphs::CNetworkOfPoses3DInf>("");
}

TEST_F(LoopClosureGraphslam, TakesActionsAndSensoryFrames)
{
    draw("--set sensors.odometry=action");
    expect_loops_to_help<mrpt::graphs::CNetworkOfPoses3DInf>("--dimensions 3d");
}

TEST_F(LoopClosureGraphslam, SaysWhatIsWrong)
{
    expect_error("", 1, "town.rawlog");
    draw("--frames 3 --set sensors.odometry=none");
    expect_error("", 1, "no odometry tells that the robot moved");
    expect_error("--dimensions 4d", 2, "see --help");
    write_text(path("fild.ini"), "[relative_pose]\nenabled = false\n");
    expect_error("", 1, "[relative_pose] enabled=false");
    write_text(path("fild.ini"), kFildConfig + std::string("[input]\nmax_entry_megabytes = 1\n"));
    for (const auto* name : {"town.rawlog", "town.gt.tum", "town.loops.txt", "town_Images"})
        fs::remove_all(path(name));
    draw("--frames 3 --embed --set sensors.width=1600 --set sensors.height=1200");
    expect_error("", 1, "more than 1 MB, [input] max_entry_megabytes");
    write_text(path("fild.ini"), "[index]\ncandidate = 1\n");
    expect_error("", 1, "candidate");
    write_text(path("engine.ini"), "[GeneralConfiguration]\nclass_verbosity = 3\n");
    expect_error("", 1, "[NodeRegistrationDeciderParameters] fild_config is missing");
    fs::remove(path("engine.ini"));
    expect_error("", 1, "engine.ini: no such file");
}

TEST_F(LoopClosureGraphslam, ShowsHelpAndVersion)
{
    const auto help = run_command("'" LOOP_CLOSURE_GRAPHSLAM "' --help");
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* flag :
         {"--rawlog", "--config", "--output", "--dimensions", "--no-loops", "--quiet"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    EXPECT_EQ(run_command("'" LOOP_CLOSURE_GRAPHSLAM "'").exit_code, 2);
    EXPECT_THAT(run_command("'" LOOP_CLOSURE_GRAPHSLAM "' --version").out, HasSubstr("0.1.0"));
}

}  // namespace
