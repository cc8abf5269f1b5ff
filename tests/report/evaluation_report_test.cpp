// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/evaluation_report.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <filesystem>

namespace
{
using fild::testing::read_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/** A run of `loop_queries` of which all but one were answered, with a curve from (0, 1) to its
 *  recall. */
fild::RunEvaluation run_of(std::size_t loop_queries)
{
    fild::RunEvaluation run;
    run.folder = "no/such/folder";
    run.score.frames = loop_queries;
    run.score.loop_queries = loop_queries;
    run.score.accepted = run.score.right = loop_queries - 1;
    run.inlier_curve.has_loop_queries = true;
    run.inlier_curve.points = {{40, 2, 2, 1.0, 0.5}, {20, 5, 4, 0.75, 1.0}};
    run.similarity_curve.kind = fild::ScoreKind::similarity;
    return run;
}

fild::EvaluationReport report_of(std::vector<fild::RunEvaluation> runs)
{
    fild::EvaluationReport report;
    report.truth.file = "loops.txt";
    report.runs = std::move(runs);
    return report;
}

/** Content of a file that write_evaluation() makes. */
std::string written(const fild::EvaluationReport& report, const std::string& name)
{
    const fild::testing::TemporaryFolder folder;
    fild::write_evaluation(report, folder.path("new/folder"));
    return read_text(folder.path("new/folder/" + name));
}

TEST(EvaluationText, CallsOnlyThePerfectPerfect)
{
    EXPECT_THAT(
        fild::to_text(report_of({run_of(2000)}), 0),
        AllOf(HasSubstr("recall           0.999  "), HasSubstr("precision        1.000  ")));
    auto hopeless = run_of(2000);
    hopeless.score.right = 0;
    EXPECT_THAT(fild::to_text(report_of({hopeless}), 0), HasSubstr("recall           0.000  "));
    hopeless.score.right = 1;
    EXPECT_THAT(fild::to_text(report_of({hopeless}), 0), HasSubstr("recall           0.001  "));
}

TEST(EvaluationText, ListsAFewWrongLoopsOfEachRun)
{
    auto run = run_of(3);
    for (std::size_t i = 1; i <= 3; ++i)
    {
        fild::FrameVerdict verdict;
        verdict.frame = fild::FrameId{i};
        verdict.candidate.emplace();
        run.score.wrong_loops.push_back({verdict, false});
    }
    const auto text = fild::to_text(report_of({run, run_of(3)}), 2);
    EXPECT_THAT(text, HasSubstr("wrong 1         frame 1 at frame 0"));
    EXPECT_THAT(text, HasSubstr("                frame 2 at frame 0"));
    EXPECT_THAT(text, HasSubstr("                and 1 more"));
    EXPECT_THAT(text, AllOf(Not(HasSubstr("frame 3 at")), Not(HasSubstr("wrong 2"))));
}

TEST(EvaluationTex, IsATableOfValuesOrOfRanges)
{
    EXPECT_THAT(written(report_of({run_of(4)}), "evaluation.tex"),
                AllOf(HasSubstr("{lr}"), HasSubstr("\nRecall & 0.750 \\\\\n")));
    EXPECT_THAT(written(report_of({run_of(4), run_of(2)}), "evaluation.tex"),
                AllOf(HasSubstr("{lrrr}"), HasSubstr("\nRecall & 0.625 & 0.500 & 0.750 \\\\\n")));
}

// The square of the plot goes from (70, 30) to (430, 390).
TEST(PrecisionRecallPlot, DrawsTheCurveAndTheRun)
{
    const auto svg = written(report_of({run_of(4)}), "precision_recall.svg");
    EXPECT_THAT(svg, HasSubstr("points='70,30 250,30 430,120'"));
    EXPECT_THAT(svg, HasSubstr("<circle cx='340' cy='30'"));
    EXPECT_THAT(svg, AllOf(HasSubstr(">recall<"), HasSubstr(">precision<")));
}

TEST(PrecisionRecallPlot, SaysWhenThereIsNothingToDraw)
{
    EXPECT_THAT(written(report_of({fild::RunEvaluation()}), "precision_recall.svg"),
                AllOf(HasSubstr("no loop query"), Not(HasSubstr("<polyline"))));
}

TEST(WriteEvaluation, NamesTheFolderThatItCannotMake)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("file"), "");
    EXPECT_THAT(
        fild::testing::message_of<std::runtime_error>(
            [&] { fild::write_evaluation(report_of({run_of(2)}), folder.path("file/out")); }),
        HasSubstr("file/out"));
}

TEST(MatchPicture, IsNamedWhenItIsThere)
{
    const fild::testing::TemporaryFolder folder;
    fild::FrameVerdict verdict;
    verdict.frame = fild::FrameId{12};
    verdict.candidate = fild::Candidate{fild::FrameId{3}, 0.9};
    EXPECT_EQ(fild::match_picture_of(folder.path(), verdict), "");
    std::filesystem::create_directory(folder.path("matches"));
    fild::testing::write_text(folder.path("matches/12_3.jpg"), "");
    EXPECT_EQ(fild::match_picture_of(folder.path(), verdict), "matches/12_3.jpg");
}

}  // namespace
