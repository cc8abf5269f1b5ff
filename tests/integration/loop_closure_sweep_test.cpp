// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval --rawlog: runs of the detector with several values and seeds.
#include "frames_csv.h"
#include "run_command.h"
#include "temporary_folder.h"
#include "two_laps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

namespace
{
using fild::testing::Finished;
using fild::testing::kFramesPerLap;
using fild::testing::lines_of;
using fild::testing::read_text;
using fild::testing::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
    return cells;
}

using Row = std::map<std::string, std::string>;

/** Rows of a CSV file by the names of its columns. */
std::vector<Row> rows_of(const std::string& csv)
{
    const auto lines = lines_of(csv);
    const auto names = cells_of(lines.at(0));
    std::vector<Row> rows;
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
        const auto cells = cells_of(lines[i]);
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < cells.size(); ++k) row[names.at(k)] = cells[k];
    }
    return rows;
}

/** Two laps along a wall; frame kFramesPerLap + i shows what frame i shows. */
class Sweep : public ::testing::Test
{
 protected:
    Sweep()
    {
        fild::testing::write_gz(folder_.path("run.rawlog"), fild::testing::two_laps());
        write_text(folder_.path("run.ini"), fild::testing::kTwoLapsConfig);
        std::string loops;
        for (std::size_t i = 0; i < kFramesPerLap; ++i)
            loops += std::to_string(kFramesPerLap + i) + " " + std::to_string(i) + "\n";
        write_text(folder_.path("loops.txt"), loops);
    }

    Finished command(const std::string& words) const
    {
        return fild::testing::run_command("cd '" + folder_.path() + "' && " + words);
    }

    Finished sweep(const std::string& more) const
    {
        return command("'" LOOP_CLOSURE_EVAL
                       "' --quiet --rawlog run.rawlog --config run.ini --ground-truth loops.txt " +
                       more);
    }

    /** Expects a failure with one line on stderr; returns the line. */
    std::string error(const std::string& more, int exit_code) const
    {
        const auto finished = sweep(more);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_EQ(lines_of(finished.err).size(), 1U) << finished.err;
        return finished.err;
    }

    std::string output(const std::string& name) const
    {
        return read_text(folder_.path("out/" + name));
    }

    fild::testing::TemporaryFolder folder_;
};

TEST_F(Sweep, HasARowForEachCombinationAndARunForEachSeed)
{
    const auto finished = sweep(
        "--sweep hashing.bits=64,256 --sweep verification.min_inliers=20,100000 --seeds "
        "1-2,5 --output out");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto rows = rows_of(output("sweep.csv"));
    ASSERT_THAT(rows, SizeIs(4));
    EXPECT_EQ(rows[0].at("hashing.bits"), "64");
    EXPECT_EQ(rows[1].at("hashing.bits"), "64");
    EXPECT_EQ(rows[2].at("hashing.bits"), "256");
    EXPECT_EQ(rows[2].at("verification.min_inliers"), "20");
    EXPECT_EQ(rows[2].at("runs"), "3");
    EXPECT_EQ(rows[2].at("recall"), "1.000000");
    EXPECT_EQ(rows[2].at("precision_min"), "1.000000");
    EXPECT_EQ(rows[3].at("recall"), "0.000000") << "a hundred thousand inliers are asked for";
    EXPECT_EQ(rows[3].count("matching_median_ms"), 1U);
    const auto runs = rows_of(output("sweep_runs.csv"));
    ASSERT_THAT(runs, SizeIs(12));
    EXPECT_EQ(runs[2].at("seed"), "5");
    EXPECT_EQ(output("sweep_wrong_loops.csv"),
              "hashing.bits,verification.min_inliers,seed,frame,candidate,similarity,"
              "matches,inliers,loop_query\n");
    EXPECT_THAT(output("sweep.tex"),
                AllOf(HasSubstr("\\texttt{hashing.bits}"),
                      HasSubstr("min\\_inliers"),
                      HasSubstr("1.000 [1.000, 1.000]")));
    EXPECT_THAT(output("sweep.svg"),
                AllOf(HasSubstr(">hashing.bits<"), HasSubstr("verification.min_inliers = 100000")));
    EXPECT_THAT(finished.out,
                AllOf(HasSubstr("hashing.bits"), HasSubstr("mean [min, max] over 3 seeds")));
}

TEST_F(Sweep, MakesEachChangeAloneBesideNone)
{
    const auto finished = sweep(
        "--change 'verification.min_inliers=100000' --change 'hashing.bits=64 "
        "local_features.hessian_threshold=2000' --output out");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto rows = rows_of(output("sweep.csv"));
    ASSERT_THAT(rows, SizeIs(3));
    EXPECT_EQ(rows[0].at("changed"), "(nothing)");
    EXPECT_EQ(rows[0].at("recall"), "1.000000");
    EXPECT_EQ(rows[1].at("recall"), "0.000000") << "a hundred thousand inliers are asked for";
    EXPECT_EQ(rows[2].at("changed"), "hashing.bits=64 local_features.hessian_threshold=2000");
    EXPECT_EQ(rows[2].at("recall"), "1.000000") << "the first change is not in force";
    EXPECT_NE(rows[2].at("threshold_at_full_precision_inliers"),
              rows[0].at("threshold_at_full_precision_inliers"));
}

TEST_F(Sweep, ScoresWhatTheMainJobFinds)
{
    ASSERT_EQ(sweep("--set hashing.bits=96 --sweep runtime.num_threads=1,2 --sweep "
                    "local_features.hessian_threshold=100,2000 --seeds 3 --output out")
                  .exit_code,
              0);
    const auto runs = rows_of(output("sweep_runs.csv"));
    ASSERT_THAT(runs, SizeIs(4));
    for (const auto& run : runs)
    {
        const auto main_job =
            command("'" RAWLOG_LOOP_CLOSURE
                    "' --quiet --rawlog run.rawlog --config run.ini --output one --set "
                    "hashing.bits=96 --set runtime.seed=3 --set local_features.hessian_threshold=" +
                    run.at("local_features.hessian_threshold") +
                    " && '" LOOP_CLOSURE_EVAL "' --run one --ground-truth loops.txt --output one");
        ASSERT_EQ(main_job.exit_code, 0) << main_job.err;
        const auto expected = rows_of(read_text(folder_.path("one/runs.csv")));
        for (const auto* metric : {"accepted",
                                   "right",
                                   "recall",
                                   "worst_wrong_inliers",
                                   "threshold_at_full_precision_inliers",
                                   "candidate_recall_1",
                                   "lost_geometry"})
            EXPECT_EQ(run.at(metric), expected.at(0).at(metric)) << metric;
    }
    EXPECT_NE(runs[0].at("threshold_at_full_precision_inliers"),
              runs[1].at("threshold_at_full_precision_inliers"))
        << "other keypoints, other inliers";
}

TEST_F(Sweep, IsTheSameWithAnyNumberOfJobs)
{
    std::string first;
    for (const std::string jobs : {"1", "2", "0"})
    {
        ASSERT_EQ(sweep("--sweep hashing.ratio=0.5,0.8 --seeds 1-2 --output out --jobs " + jobs)
                      .exit_code,
                  0);
        if (first.empty()) first = output("sweep_runs.csv");
        EXPECT_EQ(output("sweep_runs.csv"), first);
    }
}

TEST_F(Sweep, ListsWrongLoops)
{
    write_text(folder_.path("loops.txt"), "15 0\n");
    const auto finished = sweep("--seeds 1 --output out");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("wrong  seed 1: frame 8 at frame 0, "));
    EXPECT_THAT(output("sweep_wrong_loops.csv"),
                StartsWith("seed,frame,candidate,similarity,matches,inliers,loop_query\n1,8,0,"));
}

TEST_F(Sweep, StopsAtTheLimitOfFrames)
{
    write_text(folder_.path("loops.txt"), "9 1\n");
    ASSERT_EQ(sweep("--max-frames 10 --output out").exit_code, 0);
    EXPECT_EQ(rows_of(output("sweep_runs.csv")).at(0).at("recall"), "1.000000");
    EXPECT_EQ(rows_of(output("sweep_runs.csv")).at(0).at("accepted"), "2");
}

TEST_F(Sweep, SaysWhichImagesAreMissing)
{
    fild::testing::Objects objects;
    for (double seconds = 0; seconds < 16; ++seconds)
        objects.push_back(fild::testing::external_observation("gone.png", seconds));
    fild::testing::write_gz(folder_.path("run.rawlog"), objects);
    EXPECT_THAT(
        error("", 1),
        AllOf(HasSubstr("16 of 16 frames"), HasSubstr("gone.png"), HasSubstr("images_dir")));
    auto some = fild::testing::two_laps();
    some.at(3) = objects.at(3);
    fild::testing::write_gz(folder_.path("run.rawlog"), some);
    EXPECT_THAT(sweep("").out, HasSubstr("1 of 16 frames could not be used"));
}

TEST_F(Sweep, TellsABadOutputFolderBeforeItRuns)
{
    EXPECT_THAT(error("--output run.ini/out", 1), HasSubstr("run.ini/out"));
}

TEST_F(Sweep, KeepsEarlierResultsWhenInterruptedBeforeTheFirstPoint)
{
    ASSERT_EQ(sweep("--output out").exit_code, 0);
    const auto before = output("sweep.csv");
    const auto finished =
        command("timeout --signal=INT 4 '" LOOP_CLOSURE_EVAL
                "' --rawlog run.rawlog --config run.ini --ground-truth loops.txt --seeds 1-1000 "
                "--output out");
    EXPECT_NE(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("loop-closure-eval: interrupted"));
    EXPECT_EQ(output("sweep.csv"), before);
}

TEST_F(Sweep, RefusesWhatMakesNoSense)
{
    EXPECT_THAT(error("--sweep render.max_match_pictures=1,2", 2), HasSubstr("[hashing]"));
    EXPECT_THAT(error("--sweep hashing.no_such_key=1", 1), HasSubstr("no_such_key"));
    EXPECT_THAT(error("--sweep hashing.bits=64,lots", 1), HasSubstr("lots"));
    EXPECT_THAT(error("--sweep hashing.bits=", 2), HasSubstr("section.key=value"));
    EXPECT_THAT(error("--sweep hashing.bits=64,,96", 2), HasSubstr("section.key=value"));
    EXPECT_THAT(error("--sweep hashing=64", 2), HasSubstr("section.key=value"));
    EXPECT_THAT(error("--sweep runtime.seed=1,2", 2), HasSubstr("--seeds"));
    EXPECT_THAT(error("--sweep hashing.bits=64 --sweep hashing.bits=96", 2), HasSubstr("twice"));
    EXPECT_THAT(error("--change render.max_match_pictures=1", 2), HasSubstr("[hashing]"));
    EXPECT_THAT(error("--change hashing.no_such_key=1", 1), HasSubstr("no_such_key"));
    EXPECT_THAT(error("--change ''", 2), HasSubstr("--change"));
    EXPECT_THAT(error("--change hashing.bits=64 --sweep hashing.bits=64", 2),
                HasSubstr("--change does not go with --sweep"));
    for (const std::string seeds : {"3-1", "x", "1,1", "-1", "", "1-99999"})
        EXPECT_THAT(error("--seeds '" + seeds + "'", 2), HasSubstr("seeds '" + seeds + "'"));
    EXPECT_THAT(error("--run out", 2), HasSubstr("either --run or --rawlog"));
    EXPECT_THAT(error("--step 3", 2), HasSubstr("--step does not go with --rawlog"));
    EXPECT_THAT(error("--max-frames 0", 2), HasSubstr("--max-frames"));
    EXPECT_THAT(error("--set input.sensor_label=B", 1), HasSubstr("CAMERA1"));
    write_text(folder_.path("loops.txt"), "99 0\n");
    EXPECT_THAT(error("", 1), HasSubstr("99"));
}

TEST_F(Sweep, NeedsAConfigurationAndARecording)
{
    const std::string app = "'" LOOP_CLOSURE_EVAL "' --ground-truth loops.txt ";
    EXPECT_THAT(command(app).err, HasSubstr("either --run or --rawlog"));
    EXPECT_THAT(command(app + "--rawlog run.rawlog").err, HasSubstr("needs --config"));
    EXPECT_THAT(command(app + "--run x --seeds 1").err,
                HasSubstr("--seeds does not go with --run"));
    EXPECT_THAT(command(app + "--rawlog none.rawlog --config run.ini").err,
                HasSubstr("none.rawlog"));
}

}  // namespace
