// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval as its user sees it.
#include "run_command.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace
{
using fild::testing::Finished;
using fild::testing::read_text;
using ::testing::HasSubstr;

/** A run of 6 frames: 3 is rightly back at 0, 4 wrongly at 0, 5 missed. */
class LoopClosureEval : public ::testing::Test
{
 protected:
    void SetUp() override
    {
        std::filesystem::create_directory(folder_.path("run"));
        fild::testing::write_text(
            folder_.path("run/frames.csv"),
            "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
            "rejection\n"
            "0,0.0,C,9,,,0,0,0,too_early\n"
            "1,10.0,C,9,,,0,0,0,too_early\n"
            "2,20.0,C,9,,,0,0,0,too_early\n"
            "3,40.0,C,9,0,0.9,80,70,1,\n"
            "4,50.0,C,9,0,0.8,60,40,1,\n"
            "5,60.0,C,9,2,0.7,50,10,0,too_few_inliers\n");
        write("loops.txt", "3 0\n4 1\n5 2\n");
    }

    void write(const std::string& name, const std::string& text) const
    {
        fild::testing::write_text(folder_.path(name), text);
    }

    Finished run(const std::string& arguments) const
    {
        return fild::testing::run_command("cd '" + folder_.path() +
                                          "' && '" LOOP_CLOSURE_EVAL "' " + arguments);
    }

    nlohmann::json json() const
    {
        return nlohmann::json::parse(read_text(folder_.path("out/evaluation.json")));
    }

    fild::testing::TemporaryFolder folder_;
};

TEST_F(LoopClosureEval, PrintsTheScore)
{
    const auto finished = run("--run run --ground-truth loops.txt");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.err, "");
    EXPECT_EQ(finished.out,
              "run           run, 6 frames\n"
              "ground truth  loops.txt: list of loops, 3 pairs\n"
              "protocol      exact: a loop closure is right when its query and candidate are a "
              "labelled pair; neither right nor wrong when it is a pair labelled as doubtful\n"
              "loop queries       3  frames with a true loop\n"
              "accepted           2  loop closures\n"
              "  right            1\n"
              "  wrong            1\n"
              "  neither          0  left out of precision\n"
              "missed             2  loop queries without a right answer\n"
              "precision      0.500  right / (right + wrong)\n"
              "recall         0.333  right / loop queries\n"
              "wrong         frame 4 at frame 0, 40 inliers, has a loop elsewhere\n");
}

TEST_F(LoopClosureEval, WritesJsonAndWrongLoops)
{
    const auto finished = run("--run run --ground-truth loops.txt --output out/here");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(read_text(folder_.path("out/here/wrong_loops.csv")),
              "frame,candidate,similarity,matches,inliers,loop_query\n4,0,0.800000,60,40,1\n");
    const auto json = nlohmann::json::parse(read_text(folder_.path("out/here/evaluation.json")));
    EXPECT_EQ(json["protocol"]["name"], "exact");
    EXPECT_EQ(json["loop_queries"], 3);
    EXPECT_EQ(json["accepted"], 2);
    EXPECT_EQ(json["right"], 1);
    EXPECT_EQ(json["wrong"], 1);
    EXPECT_EQ(json["missed"], 2);
    EXPECT_DOUBLE_EQ(json["precision"], 0.5);
    EXPECT_DOUBLE_EQ(json["recall"], 1.0 / 3);
}

TEST_F(LoopClosureEval, WindowForgivesANeighbour)
{
    const auto finished = run("--run run --ground-truth loops.txt --protocol window:1 -o out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(json()["wrong"], 0);
    EXPECT_EQ(json()["protocol"]["window_frames"], 1);
}

TEST_F(LoopClosureEval, ScoresPoses)
{
    std::string poses;  // the way there and back, one metre a frame
    for (const std::string x : {"0", "1", "2", "2", "1", "0"})
        poses.append("1 0 0 ").append(x).append(" 0 1 0 0 0 0 1 0\n");
    write("poses.txt", poses);
    const auto finished =
        run("--run run --ground-truth poses.txt --protocol radius:1 --min-age 35 -o out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(json()["loop_queries"], 2);  // 4 at 0 and 1, 5 at 0 and 1; 3 at 1 only 30 s ago
    EXPECT_EQ(json()["right"], 1);
    EXPECT_EQ(json()["wrong"], 1);
    EXPECT_EQ(json()["protocol"]["min_age_seconds"], 35);
}

TEST_F(LoopClosureEval, HasNullWhereNothingCanBeSaid)
{
    write("poses.txt", "0 0 0 0 0 0 0 1\n");
    const auto finished = run("--run run --ground-truth poses.txt --protocol radius:1 -o out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_TRUE(json()["precision"].is_null());
    EXPECT_TRUE(json()["recall"].is_null());
    EXPECT_EQ(json()["neither"], 2);
    EXPECT_THAT(finished.out, HasSubstr("recall             -"));
}

TEST_F(LoopClosureEval, FailsWithOneLine)
{
    write("loops.txt", "6 0\n");
    const auto finished = run("--run run --ground-truth loops.txt --output out");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_EQ(finished.err,
              "loop-closure-eval: loops.txt names frame 6, the run has 6 frames from 0; is it the "
              "truth of this recording?\n");
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
    EXPECT_EQ(run("--run none --ground-truth loops.txt").exit_code, 1);
}

TEST_F(LoopClosureEval, KnowsWrongUsage)
{
    EXPECT_EQ(run("--help").exit_code, 0);
    EXPECT_EQ(run("--version").exit_code, 0);
    EXPECT_EQ(run("--run run").exit_code, 2);
    EXPECT_EQ(run("--run run --ground-truth loops.txt --protocol near").exit_code, 2);
    EXPECT_EQ(run("--run run --ground-truth loops.txt --protocol radius:1").exit_code, 2);
    EXPECT_EQ(run("--run run --ground-truth loops.txt --min-age 3").exit_code, 2);
}

}  // namespace
