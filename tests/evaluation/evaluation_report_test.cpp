// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/evaluation_report.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <opencv2/imgcodecs.hpp>

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

// The square of the plot goes from (70, 70) to (430, 430).
TEST(PrecisionRecallPlot, DrawsTheCurveAndTheRun)
{
    const auto svg = written(report_of({run_of(4)}), "precision_recall.svg");
    EXPECT_THAT(svg, HasSubstr("points='70,70 250,70 430,160'"));
    EXPECT_THAT(svg, HasSubstr("<circle cx='340' cy='70'"));
    EXPECT_THAT(svg, AllOf(HasSubstr(">recall<"), HasSubstr(">precision<")));
}

TEST(PrecisionRecallPlot, NamesRunTruthAndThresholds)
{
    auto named = report_of({run_of(4)});
    named.runs.front().folder = "results/<one>/";
    const auto svg = written(named, "precision_recall.svg");
    EXPECT_THAT(
        svg, AllOf(HasSubstr(">&lt;one&gt;, 4 frames<"), HasSubstr(">against loops.txt (exact)<")));
    EXPECT_THAT(svg, AllOf(HasSubstr(">40<"), HasSubstr(">20<"))) << "inliers";
    const auto several = written(report_of({run_of(4), run_of(4)}), "precision_recall.svg");
    EXPECT_THAT(several, AllOf(HasSubstr(">2 runs, 4 frames<"), Not(HasSubstr(">40<"))));
}

TEST(PrecisionRecallPlot, IsAPngToo)
{
    const fild::testing::TemporaryFolder folder;
    fild::write_evaluation(report_of({run_of(4)}), folder.path("out"));
    const auto picture = cv::imread(folder.path("out/precision_recall.png"));
    ASSERT_EQ(picture.size(), cv::Size(2 * 460, 2 * 540));
    const auto at = [&](int x, int y) { return picture.at<cv::Vec3b>(2 * y, 2 * x); };
    EXPECT_EQ(at(160, 70), cv::Vec3b(0xB2, 0x72, 0)) << "the curve";
    EXPECT_EQ(at(340, 70), cv::Vec3b(0, 0, 0)) << "the run";
    EXPECT_EQ(at(250, 300), cv::Vec3b(255, 255, 255));
}

TEST(PrecisionRecallPlot, SaysWhenThereIsNothingToDraw)
{
    const auto svg = written(report_of({fild::RunEvaluation()}), "precision_recall.svg");
    EXPECT_THAT(svg, HasSubstr("no loop query"));
    EXPECT_EQ(svg.find("#0072B2"), svg.rfind("#0072B2")) << "only in the legend";
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
