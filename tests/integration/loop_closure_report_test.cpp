// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_folder_files.h"
#include "run_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using fild::testing::data_of_page;
using fild::testing::Finished;
using fild::testing::frame_at;
using fild::testing::loop_at;
using fild::testing::RunFolderFiles;
using fild::testing::write_text;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Finished report(const std::string& arguments)
{
    return fild::testing::run_command("'" LOOP_CLOSURE_REPORT "' " + arguments);
}

/** Expects a failure with one line on stderr; returns the line. */
std::string error(const std::string& arguments, int exit_code)
{
    const auto finished = report(arguments);
    EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
    EXPECT_THAT(finished.err, StartsWith("loop-closure-report: "));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    return finished.err;
}

/** Frames along a line of 1 m a frame, there and back. */
class LoopClosureReport : public ::testing::Test
{
 protected:
    LoopClosureReport()
        : run_({frame_at(0), frame_at(1), frame_at(2), loop_at(3, 1), loop_at(4, 0)}),
          truth_(run_.path("truth.tum")),
          loops_(run_.path("truth.txt"))
    {
        std::string poses;
        for (const auto* place : {"0 0 0", "1 0 0", "2 0 0", "1 0 0", "0 0 0"})
            poses += std::to_string(1000 + 0.1 * static_cast<double>(std::count(
                                                     poses.begin(), poses.end(), '\n'))) +
                     " " + place + " 0 0 0 1\n";
        write_text(truth_, poses);
        write_text(loops_, "3 1\n4 0\n");
        write_text(run_.path("trajectory_input.tum"), poses);
    }

    const RunFolderFiles run_;
    const std::string truth_;
    const std::string loops_;
};

TEST_F(LoopClosureReport, ShowsHelpAndVersion)
{
    const auto help = report("--help");
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* flag : {"--run", "--compare", "--output", "--ground-truth", "--max-pictures"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    EXPECT_THAT(report("--version").out, HasSubstr("0.1.0"));
}

TEST_F(LoopClosureReport, ExitsWithTwoOnWrongUsage)
{
    const auto folder = "'" + run_.path() + "'";
    EXPECT_THAT(error("", 2), HasSubstr("either --run DIR or --compare DIR1 DIR2"));
    EXPECT_THAT(error("--compare " + folder, 2), HasSubstr("two folders"));
    EXPECT_THAT(error("--run " + folder + " " + folder, 2), HasSubstr("none to --run"));
    EXPECT_THAT(error("--run " + folder + " --output x.html", 2), HasSubstr("--output"));
    EXPECT_THAT(error("--run " + folder + " --protocol exact", 2), HasSubstr("--ground-truth"));
    EXPECT_THAT(error("--run " + folder + " --max-pictures -1", 2), HasSubstr("max_pictures"));
}

TEST_F(LoopClosureReport, JudgesTheRunByItsGroundTruth)
{
    const auto finished = report("--run '" + run_.path() + "' --ground-truth '" + loops_ + "'");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, run_.path() + "/report.html\n");
    const auto data = data_of_page(run_.path("report.html"));
    EXPECT_EQ(data["evaluation"]["precision"], 1);
    EXPECT_EQ(data["evaluation"]["recall"], 1);
    EXPECT_THAT(data["remarks"][0].get<std::string>(), HasSubstr(loops_));
}

TEST_F(LoopClosureReport, MeasuresTheTrajectoryByTruePoses)
{
    const auto finished =
        report("--run '" + run_.path() + "' --ground-truth '" + truth_ + "' --protocol radius:0.5");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto data = data_of_page(run_.path("report.html"));
    EXPECT_NEAR(data["evaluation"]["ate_input_m"].get<double>(), 0, 1e-6);
    EXPECT_EQ(data["trajectories"]["truth"].size(), 5U);
}

TEST_F(LoopClosureReport, ComparesTwoRuns)
{
    const RunFolderFiles other({frame_at(0), frame_at(1), frame_at(2), frame_at(3), loop_at(4, 0)});
    const auto page = run_.path("page.html");
    const auto finished = report("--compare '" + run_.path() + "' '" + other.path() +
                                 "' --output '" + page + "' --ground-truth '" + loops_ + "'");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, page + "\n");
    const auto runs = data_of_page(page)["runs"];
    EXPECT_EQ(runs[0]["loops"].size(), 2U);
    EXPECT_EQ(runs[1]["loops"].size(), 1U);
    EXPECT_EQ(runs[0]["evaluation"]["recall"], 1);
    EXPECT_EQ(runs[1]["evaluation"]["recall"], 0.5);
}

TEST_F(LoopClosureReport, NamesWhatIsMissing)
{
    EXPECT_THAT(error("--run /no/such/run", 1), HasSubstr("/no/such/run/summary.json"));
    EXPECT_THAT(error("--run '" + run_.path() + "' --ground-truth /no/such.tum", 1),
                HasSubstr("/no/such.tum"));
    EXPECT_THAT(error("--compare '" + run_.path() + "' '" + run_.path() +
                          "' --output /no/such/folder/page.html",
                      1),
                HasSubstr("/no/such/folder/page.html"));
    write_text(run_.path("trajectory_input.tum"), "1000 0 0");
    EXPECT_THAT(error("--run '" + run_.path() + "'", 1),
                HasSubstr(run_.path("trajectory_input.tum")));
}

}  // namespace
