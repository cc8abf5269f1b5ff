// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval as its user sees it.
#include "rawlog/drawn_rawlog.h"
#include "run_command.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace
{
using fild::testing::Finished;
using fild::testing::read_text;
using ::testing::AllOf;
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
            "rejection,support\n"
            "0,0.0,C,9,,,0,0,0,too_early,0\n"
            "1,10.0,C,9,,,0,0,0,too_early,0\n"
            "2,20.0,C,9,,,0,0,0,too_early,0\n"
            "3,40.0,C,9,0,0.9,80,70,1,,3.5\n"
            "4,50.0,C,9,0,0.8,60,40,1,,2\n"
            "5,60.0,C,9,2,0.7,50,10,0,too_few_inliers,0\n");
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
              "run             run, 6 frames\n"
              "                no candidates.csv in run: no candidate recall, no stages of loss\n"
              "ground truth    loops.txt: list of loops, 3 pairs\n"
              "protocol        exact: a loop closure is right when its query and candidate are a "
              "labelled pair; neither right nor wrong when it is a pair labelled as doubtful\n"
              "loop queries         3  frames with a true loop\n"
              "accepted             2  loop closures\n"
              "  right              1\n"
              "  wrong              1\n"
              "  neither            0  left out of precision\n"
              "missed               2  loop queries without a right answer\n"
              "precision        0.500  right / (right + wrong)\n"
              "recall           0.333  right / loop queries\n"
              "stretches            1  rows of loop queries, gaps up to 3 frames\n"
              "  found              1  of 1, with a right loop closure\n"
              "segment recall   1.000  found / stretches\n"
              "worst wrong      2.000  greatest support of a wrong candidate, accepted or not\n"
              "  inliers           40  of the same\n"
              "by inliers: if all candidates from a threshold up were accepted\n"
              "  recall, P = 1  0.333  the greatest before the first wrong one\n"
              "  from              70  inliers up\n"
              "  maximum F1     0.667  2 P R / (P + R)\n"
              "  from              10  inliers up\n"
              "  average P      0.556  average precision: sum of P times gain in R\n"
              "by similarity: if all candidates from a threshold up were accepted\n"
              "  recall, P = 1  0.333  the greatest before the first wrong one\n"
              "  from           0.900  similarity up\n"
              "  maximum F1     0.667  2 P R / (P + R)\n"
              "  from           0.700  similarity up\n"
              "  average P      0.556  average precision: sum of P times gain in R\n"
              "worst pair      frame 4 at frame 0, 40 inliers, accepted\n"
              "wrong           frame 4 at frame 0, 40 inliers, has a loop elsewhere\n");
}

TEST_F(LoopClosureEval, WritesJsonAndWrongLoops)
{
    std::filesystem::create_directory(folder_.path("run/matches"));
    write("run/matches/4_0.jpg", "");
    const auto finished = run("--run run --ground-truth loops.txt --output out/here");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(read_text(folder_.path("out/here/wrong_loops.csv")),
              "run,frame,candidate,similarity,matches,inliers,loop_query,picture\n"
              "1,4,0,0.800000,60,40,1,matches/4_0.jpg\n");
    EXPECT_THAT(finished.out, HasSubstr("has a loop elsewhere, matches/4_0.jpg"));
    const auto json = nlohmann::json::parse(read_text(folder_.path("out/here/evaluation.json")));
    EXPECT_EQ(json["protocol"]["name"], "exact");
    EXPECT_EQ(json["loop_queries"], 3);
    EXPECT_EQ(json["accepted"], 2);
    EXPECT_EQ(json["right"], 1);
    EXPECT_EQ(json["wrong"], 1);
    EXPECT_EQ(json["missed"], 2);
    EXPECT_DOUBLE_EQ(json["precision"], 0.5);
    EXPECT_DOUBLE_EQ(json["recall"], 1.0 / 3);
    EXPECT_EQ(json["worst_wrong_pair"]["frame"], 4);
    EXPECT_EQ(json["worst_wrong_pair"]["candidate"], 0);
    EXPECT_EQ(json["worst_wrong_pair"]["inliers"], 40);
    EXPECT_EQ(json["worst_wrong_pair"]["support"], 2);
    EXPECT_EQ(json["worst_wrong_pair"]["accepted"], true);
    EXPECT_TRUE(json["candidate_recall_5"].is_null());
    EXPECT_TRUE(json["lost_geometry"].is_null());
    EXPECT_TRUE(json["ate_input_m"].is_null());
}

TEST_F(LoopClosureEval, WritesCurvesTableAndPlot)
{
    ASSERT_EQ(run("--run run --ground-truth loops.txt --output out").exit_code, 0);
    EXPECT_EQ(read_text(folder_.path("out/curve_inliers.csv")),
              "run,threshold,accepted,precision,recall\n"
              "1,70,1,1.000000,0.333333\n"
              "1,40,2,0.500000,0.333333\n"
              "1,10,3,0.666667,0.666667\n");
    EXPECT_THAT(read_text(folder_.path("out/curve_similarity.csv")),
                HasSubstr("1,0.800000,2,0.500000,0.333333\n"));
    EXPECT_EQ(read_text(folder_.path("out/stretches.csv")),
              "run,first,last,loop_queries,answered\n1,3,5,3,1\n");
    EXPECT_THAT(read_text(folder_.path("out/evaluation.tex")),
                AllOf(HasSubstr("\\toprule"), HasSubstr("Recall & 0.333 \\\\\n")));
    EXPECT_THAT(read_text(folder_.path("out/precision_recall.svg")),
                AllOf(HasSubstr(">by inliers<"), HasSubstr(">by similarity<")));
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out/missed_loops.csv")));
}

// Frame 4 had its true place as second answer, but too few inliers there; frame 5 found its own.
TEST_F(LoopClosureEval, SaysWhereLoopsWereLost)
{
    write("run/candidates.csv",
          "frame,rank,candidate,similarity,checked,matches,inliers,rejection,support\n"
          "3,1,0,0.9,1,80,70,,0\n"
          "4,1,0,0.8,1,60,40,,0\n"
          "4,2,1,0.7,1,30,12,too_few_inliers,0\n"
          "5,1,1,0.7,1,99,50,too_few_inliers,0\n"
          "5,2,2,0.7,0,0,0,,0\n");
    const auto finished = run("--run run --ground-truth loops.txt --output out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out,
                HasSubstr("  at 1           0.333  of the loop queries\n"
                          "  at 5           1.000  of the loop queries\n"
                          "  at 10          1.000  of the loop queries\n"));
    EXPECT_THAT(finished.out, HasSubstr("  geometry           1  "));
    EXPECT_EQ(json()["lost_geometry"], 1);
    EXPECT_EQ(json()["lost_retrieval"], 1);
    EXPECT_EQ(json()["lost_choice"], 0);
    EXPECT_EQ(json()["worst_wrong_pair"]["inliers"], 40);
    EXPECT_EQ(read_text(folder_.path("out/missed_loops.csv")),
              "run,frame,stage\n1,4,geometry\n1,5,retrieval\n");
    EXPECT_TRUE(json()["remarks"].empty());
}

TEST_F(LoopClosureEval, RangesOverRuns)
{
    std::filesystem::create_directory(folder_.path("seed2"));
    auto frames = read_text(folder_.path("run/frames.csv"));
    const auto lost = frames.find("3,40.0");
    const auto next = frames.find("4,50.0");
    frames.replace(lost, next - lost, "3,40.0,C,9,0,0.9,80,9,0,too_few_inliers,0\n");
    write("seed2/frames.csv", frames);
    const auto finished = run("--run run --run seed2 --ground-truth loops.txt --output out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("recall          0.167 [0.000, 0.333]"));
    EXPECT_THAT(finished.out, HasSubstr("accepted                  1.5 [1, 2]"));
    const auto recall = json()["metrics"]["recall"];
    EXPECT_DOUBLE_EQ(recall["mean"], 1.0 / 6);
    EXPECT_EQ(recall["min"], 0);
    EXPECT_EQ(recall["runs"], 2);
    EXPECT_TRUE(json()["metrics"]["ate_input_m"].is_null());
    EXPECT_EQ(json()["runs"].size(), 2U);
    EXPECT_EQ(json()["runs"][1]["run"], "seed2");
    EXPECT_EQ(json()["runs"][1]["accepted"], 1);
    EXPECT_THAT(read_text(folder_.path("out/wrong_loops.csv")), HasSubstr("\n2,4,0,"));
    EXPECT_THAT(read_text(folder_.path("out/evaluation.tex")),
                HasSubstr("Recall & 0.167 & 0.000 & 0.333 \\\\\n"));
}

TEST_F(LoopClosureEval, ComparesTrajectoriesWithPoses)
{
    std::string truth;
    std::string input;
    for (const auto& [time, x] :
         {std::pair("0", "0"), {"10", "1"}, {"20", "2"}, {"40", "2"}, {"50", "1"}, {"60", "0"}})
    {
        truth.append(time).append(" ").append(x).append(" 0 0 0 0 0 1\n");
        input.append(time).append(" 5 ").append(x).append(" 0 0 0 0 1\n");
    }
    write("poses.tum", truth);
    write("run/trajectory_input.tum", input);
    const auto by_poses =
        run("--run run --ground-truth poses.tum --protocol radius:1 --step 2 -o out");
    EXPECT_EQ(by_poses.exit_code, 0) << by_poses.err;
    EXPECT_NEAR(json()["ate_input_m"], 0, 1e-9);
    EXPECT_NEAR(json()["rpe_input_2m_m"], 0, 1e-9);
    EXPECT_TRUE(json()["ate_optimized_m"].is_null());
    EXPECT_THAT(by_poses.out, HasSubstr("  ATE            0.000  m, RMSE after alignment\n"));

    const auto by_labels =
        run("--run run --ground-truth loops.txt --true-trajectory poses.tum "
            "--trajectory poses.tum -o out");
    EXPECT_EQ(by_labels.exit_code, 0) << by_labels.err;
    EXPECT_NEAR(json()["ate_poses_m"], 0, 1e-9);
    EXPECT_TRUE(json()["ate_input_m"].is_null());
    EXPECT_EQ(
        run("--run run --ground-truth loops.txt --trajectory run/trajectory_input.tum").exit_code,
        2);
}

// The robot drives two metres in 20 s, waits as long, and drives back.
TEST_F(LoopClosureEval, ScoresByThePosesInARawlog)
{
    fild::testing::Objects poses;
    for (int seconds = 0; seconds <= 60; seconds += 5)
    {
        auto pose = mrpt::obs::CObservationRobotPose::Create();
        pose->timestamp = mrpt::Clock::fromDouble(seconds);
        pose->sensorLabel = "MOCAP";
        pose->pose.mean.x(0.1 * std::min({seconds, 20, 60 - seconds}));
        poses.push_back(pose);
    }
    fild::testing::write_gz(folder_.path("drive.rawlog"), poses);
    const auto finished =
        run("--run run --ground-truth drive.rawlog --truth-sensor MOCAP --protocol radius:1 "
            "--min-age 35 -o out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("robot poses 'MOCAP' of 6 frames"));
    EXPECT_EQ(json()["loop_queries"], 2);
    EXPECT_EQ(json()["right"], 1);
    EXPECT_EQ(json()["wrong"], 1);
    EXPECT_EQ(run("--run run --ground-truth drive.rawlog -p exact").exit_code, 2);
    EXPECT_EQ(run("--run run --ground-truth drive.rawlog -o out").exit_code, 0);
    EXPECT_EQ(json()["protocol"]["radius_metres"], 5);
    EXPECT_EQ(run("--run run --ground-truth drive.rawlog --truth-sensor GPS -p radius:1").exit_code,
              1);
}

TEST_F(LoopClosureEval, RefusesRunsOfOtherRecordings)
{
    std::filesystem::create_directory(folder_.path("short"));
    write("short/frames.csv",
          "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
          "rejection,support\n"
          "0,0.0,C,9,,,0,0,0,too_early,0\n");
    const auto finished = run("--run run --run short --ground-truth loops.txt --output out");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_EQ(finished.err,
              "loop-closure-eval: short has another number of frames (1, not 6) than run; only "
              "runs of one recording are evaluated together\n");
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
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

    write("run/summary.json", R"({"options": {"index": {"delay_seconds": "35"}}})");
    ASSERT_EQ(run("--run run --quiet --ground-truth poses.txt -p radius:1 -o out").exit_code, 0);
    EXPECT_EQ(json()["protocol"]["min_age_seconds"], 35) << "the delay of the run";
    EXPECT_EQ(json()["loop_queries"], 2);
}

TEST_F(LoopClosureEval, HasNullWhereNothingCanBeSaid)
{
    write("poses.txt", "0 0 0 0 0 0 0 1\n");
    const auto finished = run("--run run --ground-truth poses.txt --protocol radius:1 -o out");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_TRUE(json()["precision"].is_null());
    EXPECT_TRUE(json()["recall"].is_null());
    EXPECT_EQ(json()["neither"], 2);
    EXPECT_THAT(finished.out, HasSubstr("recall               -"));
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
    EXPECT_EQ(run("--run run --ground-truth loops.txt --step 0").exit_code, 2);
    EXPECT_EQ(run("--run run --ground-truth loops.txt --truth-sensor GPS").exit_code, 2);
}

}  // namespace
