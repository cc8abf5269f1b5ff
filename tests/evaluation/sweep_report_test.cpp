// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/sweep_report.h"

#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::read_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/** Of `loop_queries` all but `missed` are answered rightly. */
fild::RunEvaluation run_of(std::size_t loop_queries, std::size_t missed)
{
    fild::RunEvaluation run;
    run.score.frames = 100;
    run.score.loop_queries = loop_queries;
    run.score.accepted = run.score.right = loop_queries - missed;
    return run;
}

fild::SweepPoint point_of(const std::vector<std::string>& values,
                          const std::vector<fild::RunEvaluation>& runs)
{
    fild::SweepPoint point;
    point.values = values;
    point.runs = runs;
    for (std::size_t i = 0; i < runs.size(); ++i) point.seeds.push_back(static_cast<int>(i) + 1);
    point.times.add("matching", 1.5);
    return point;
}

fild::SweepReport report_of(const std::vector<std::string>& keys,
                            const std::vector<fild::SweepPoint>& points)
{
    fild::SweepReport report;
    report.rawlog = "drive.rawlog";
    report.config = "run.ini";
    report.keys = keys;
    report.points = points;
    return report;
}

std::string written(const fild::SweepReport& report, const std::string& name)
{
    const fild::testing::TemporaryFolder folder;
    fild::write_sweep(report, folder.path("new/folder"));
    return read_text(folder.path("new/folder/" + name));
}

TEST(SweepText, GivesMeanAndRangeOverSeeds)
{
    const auto report = report_of({"a.b"}, {point_of({"7"}, {run_of(10, 2), run_of(10, 4)})});
    const auto text = fild::to_text(report, 0);
    EXPECT_THAT(text,
                AllOf(HasSubstr("  7  0.700 [0.600, 0.800]  1.000 [1.000, 1.000]"),
                      HasSubstr("mean [min, max] over 2 seeds")));
    EXPECT_THAT(fild::to_text(report_of({"a.b"}, {point_of({"7"}, {run_of(10, 2)})}), 0),
                AllOf(HasSubstr("  7   0.800"), Not(HasSubstr("["))));
}

TEST(SweepCsv, QuotesValuesThatHoldCommas)
{
    const auto report = report_of({"input.sensor_label"}, {point_of({"A,\"B\""}, {run_of(10, 2)})});
    for (const auto* name : {"sweep.csv", "sweep_runs.csv"})
        EXPECT_THAT(written(report, name), HasSubstr("\n\"A,\"\"B\"\"\",1,")) << name;
}

TEST(SweepText, SaysWhatIsUndefined)
{
    const auto report = report_of({"a.b"}, {point_of({"7"}, {run_of(0, 0)})});
    EXPECT_THAT(fild::to_text(report, 0), HasSubstr("  7       -          -"));
    EXPECT_THAT(written(report, "sweep.tex"), HasSubstr("\n7 & -- & -- & "));
    EXPECT_THAT(written(report, "sweep_runs.csv"), Not(HasSubstr("recall_at")));
}

TEST(SweepText, ListsAFewWrongLoops)
{
    auto run = run_of(3, 0);
    for (std::size_t i = 1; i <= 3; ++i)
    {
        fild::FrameVerdict verdict;
        verdict.frame = fild::FrameId{i};
        verdict.candidate.emplace();
        run.score.wrong_loops.push_back({verdict, false});
    }
    const auto text = fild::to_text(report_of({"a.b"}, {point_of({"7"}, {run})}), 2);
    EXPECT_THAT(text,
                AllOf(HasSubstr("wrong  7, seed 1: frame 1 at frame 0, 0 inliers\n"),
                      HasSubstr("frame 2 at frame 0"),
                      HasSubstr("and 1 more"),
                      Not(HasSubstr("frame 3 at"))));
}

// The first plot goes from (70, 40) to (350, 260).
TEST(SweepPlot, DrawsALineForEachCombinationOfTheOtherKeys)
{
    const auto svg = written(report_of({"a.b", "c.d"},
                                       {point_of({"1", "x"}, {run_of(10, 5)}),
                                        point_of({"1", "y"}, {run_of(10, 0)}),
                                        point_of({"2", "x"}, {run_of(10, 10)}),
                                        point_of({"2", "y"}, {run_of(10, 0)})}),
                             "sweep.svg");
    EXPECT_THAT(svg, HasSubstr("points='140,150 280,260 '"));
    EXPECT_THAT(svg, HasSubstr("points='140,40 280,40 '"));
    EXPECT_THAT(svg, AllOf(HasSubstr(">a.b<"), HasSubstr(">c.d = x<"), HasSubstr(">c.d = y<")));
}

TEST(SweepPlot, WritesLongValuesUpwards)
{
    const auto report = report_of({"changed"}, {point_of({std::string(60, 'w')}, {run_of(10, 5)})});
    EXPECT_THAT(written(report, "sweep.svg"), HasSubstr("rotate(-90)' text-anchor='end'>www"));
}

TEST(WriteSweep, NamesTheFolderThatItCannotMake)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("file"), "");
    EXPECT_THAT(fild::testing::message_of<std::runtime_error>(
                    [&] { fild::write_sweep(report_of({}, {}), folder.path("file/out")); }),
                HasSubstr("file/out"));
}

}  // namespace
