// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/html_report.h"

#include "fild/evaluation/loop_labels.h"
#include "fild/results/poses_csv.h"
#include "message_of.h"
#include "run_folder_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace
{
using fild::testing::data_of_page;
using fild::testing::frame_at;
using fild::testing::loop_at;
using fild::testing::read_text;
using fild::testing::rejected_at;
using fild::testing::RunFolderFiles;
using fild::testing::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

nlohmann::json report_of(const RunFolderFiles& run, const fild::TReportOptions& options = {})
{
    fild::write_html_report(run.path(), options);
    return data_of_page(run.path("report.html"));
}

std::string error_of(const RunFolderFiles& run)
{
    return fild::testing::message_of<std::runtime_error>(
        [&] { fild::write_html_report(run.path(), {}); });
}

/** Frames 0 and 1, then 2 and 3 that are back at them. */
std::vector<fild::FrameVerdict> two_laps()
{
    return {frame_at(0), frame_at(1), loop_at(2, 0), loop_at(3, 1)};
}

TEST(HtmlReport, HoldsTheRunAndNeedsNothingElse)
{
    const RunFolderFiles run(two_laps());
    run.add_match_picture(loop_at(2, 0));
    const auto data = report_of(run);
    EXPECT_EQ(data["frames"]["timestamp"].size(), 4U);
    EXPECT_EQ(data["loops"].size(), 2U);
    EXPECT_EQ(data["loops"][0]["candidate"], 0);
    EXPECT_EQ(data["pictures"].size(), 1U);
    EXPECT_THAT(data["pictures"]["2_0"].get<std::string>(), StartsWith("data:image/jpeg;base64,"));
    EXPECT_EQ(data["summary"]["options"]["runtime"]["seed"], "1");
    const auto page = read_text(run.path("report.html"));
    EXPECT_THAT(page, AllOf(HasSubstr("Apache License"), Not(HasSubstr("src=\"http"))));
}

TEST(HtmlReport, GivesTheSameBytesAgain)
{
    const RunFolderFiles run(two_laps());
    report_of(run);
    const auto first = read_text(run.path("report.html"));
    report_of(run);
    EXPECT_EQ(read_text(run.path("report.html")), first);
}

TEST(HtmlReport, LetsNoTextEndItsScript)
{
    RunFolderFiles run(two_laps());
    run.summary().rawlog = "</script><script>alert('&amp;')</script>@DATA@";
    run.write();
    EXPECT_EQ(report_of(run)["summary"]["rawlog"], run.summary().rawlog);
}

TEST(HtmlReport, BoundsItsPictures)
{
    std::vector<fild::FrameVerdict> frames = {frame_at(0)};
    for (std::size_t i = 1; i <= 8; ++i)
        frames.push_back(i <= 4 ? loop_at(i, 0) : rejected_at(i, 0, 0.1 * static_cast<double>(i)));
    const RunFolderFiles run(frames);
    for (std::size_t i = 1; i < frames.size(); ++i) run.add_match_picture(frames[i]);
    EXPECT_EQ(report_of(run)["pictures"].size(), 8U);
    fild::TReportOptions options;
    options.max_pictures = 4;
    options.picture_width_px = 100;
    const auto pictures = report_of(run, options)["pictures"];
    EXPECT_EQ(pictures.size(), 4U);
    EXPECT_TRUE(pictures.contains("8_0"));  // the strongest two of the rejected ones
    EXPECT_TRUE(pictures.contains("7_0"));
    options.max_pictures = 0;
    EXPECT_TRUE(report_of(run, options)["pictures"].empty());
}

TEST(HtmlReport, HasPicturesIn3dWhereThereIsRoom)
{
    std::vector<fild::FrameVerdict> frames = {frame_at(0)};
    for (std::size_t i = 1; i <= 4; ++i) frames.push_back(loop_at(i, 0));
    const RunFolderFiles run(frames);
    for (std::size_t i = 1; i <= 4; ++i) run.add_match_picture(frames[i]);
    EXPECT_TRUE(report_of(run)["pictures_3d"].empty());
    for (std::size_t i = 2; i <= 4; ++i) run.add_match_picture(frames[i], "_3d");
    const auto data = report_of(run);
    EXPECT_EQ(data["pictures"].size(), 4U);
    EXPECT_EQ(data["pictures_3d"].size(), 3U);
    EXPECT_THAT(data["pictures_3d"]["2_0"].get<std::string>(), StartsWith("data:image/jpeg;"));

    fild::TReportOptions options;
    options.max_pictures = 5;
    EXPECT_EQ(report_of(run, options)["pictures"].size(), 4U);
    EXPECT_EQ(report_of(run, options)["pictures_3d"].size(), 1U);
    options.max_pictures = 3;
    EXPECT_EQ(report_of(run, options)["pictures"].size(), 3U);
    EXPECT_TRUE(report_of(run, options)["pictures_3d"].empty());
}

TEST(HtmlReport, ReadsTrajectoriesOfBothFormats)
{
    const RunFolderFiles run({frame_at(0), frame_at(1)});
    write_text(run.path("trajectory_input.kitti"),
               "0 -1 0 5 1 0 0 2 0 0 1 3\n1 0 0 6 0 1 0 7 0 0 1 8\n");
    write_text(run.path("trajectory_optimized.tum"), "1000.100000 5 4 0 0 0 0 1\n");
    const auto trajectories = report_of(run)["trajectories"];
    EXPECT_EQ(trajectories["input"][0], (std::vector<double>{5, 2, 3}));
    EXPECT_EQ(trajectories["input"][1], (std::vector<double>{6, 7, 8}));
    EXPECT_TRUE(trajectories["optimized"][0].is_null());
    EXPECT_EQ(trajectories["optimized"][1], (std::vector<double>{5, 4, 0}));

    write_text(run.path("trajectory_input.kitti"), "1 0 0 6 0 1 0 7 0 0 1 8\n");
    EXPECT_THAT(error_of(run), HasSubstr("trajectory_input.kitti"));
}

/** MRPT's clock has steps of 100 ns, frames.csv decimals of 1 us. */
std::vector<fild::FrameVerdict> frames_between_microseconds()
{
    std::vector<fild::FrameVerdict> frames;
    for (std::size_t i = 0; i < 2000; ++i)
    {
        frames.push_back(frame_at(i));
        frames.back().timestamp = 1.7e9 + 0.0334177 * static_cast<double>(i);
    }
    return frames;
}

std::size_t frames_without_position(const nlohmann::json& positions)
{
    return static_cast<std::size_t>(std::count_if(
        positions.begin(), positions.end(), [](const auto& point) { return point.is_null(); }));
}

TEST(HtmlReport, FindsEveryPoseWhateverItsStamp)
{
    const auto frames = frames_between_microseconds();
    const RunFolderFiles run(frames);
    std::ofstream tum(run.path("trajectory_input.tum"));
    tum.precision(17);
    for (const auto& frame : frames) tum << frame.timestamp << " 1 2 3 0 0 0 1\n";
    tum.close();
    EXPECT_EQ(frames_without_position(report_of(run)["trajectories"]["input"]), 0U);
}

TEST(HtmlReport, TakesPosesByTheNumberOfTheFrame)
{
    auto frames = frames_between_microseconds();
    frames.resize(3);
    frames[2].timestamp = frames[0].timestamp;  // the clock was set back
    const RunFolderFiles run(frames);
    write_text(run.path("trajectory_input.tum"), "of no use\n");
    fild::CsvWriter<fild::PoseRow> poses(run.path("poses.csv"), fild::poses_csv_columns());
    poses.add({fild::FrameId{0}, {1, 2, 3, 0, 0, 0, 1}, {1, 2, 4, 0, 0, 0, 1}});
    poses.add({fild::FrameId{2}, {0.1, 0.2, 0.3, 0, 0, 1, 0}, {5, 6, 7, 0, 0, 1, 0}});
    poses.commit();
    const auto trajectories = report_of(run)["trajectories"];
    EXPECT_EQ(trajectories["input"][0], (std::vector<double>{1, 2, 3}));
    EXPECT_TRUE(trajectories["input"][1].is_null());
    EXPECT_EQ(trajectories["input"][2], (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_EQ(trajectories["optimized"][2], (std::vector<double>{5, 6, 7}));

    std::ofstream(run.path("poses.csv"), std::ios::app) << "3,0,0,0,0,0,0,1,0,0,0,0,0,0,1\n";
    EXPECT_THAT(error_of(run), AllOf(HasSubstr("poses.csv line 4"), HasSubstr("3 frames")));
}

/** The true poses of a way are known in a frame of their own: turned by 90 degrees, and elsewhere.
 */
TEST(HtmlReport, LaysTheTruthOverTheMap)
{
    const RunFolderFiles run({frame_at(0), frame_at(1), frame_at(2), loop_at(3, 0)});
    std::string optimized;
    fild::ReportTruth truth;
    const std::vector<cv::Vec3d> way{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 1}};
    for (std::size_t i = 0; i < way.size(); ++i)
    {
        const auto timestamp = frame_at(i).timestamp;
        optimized += std::to_string(timestamp);
        for (int axis = 0; axis < 3; ++axis) optimized += " " + std::to_string(way[i][axis]);
        optimized += " 0 0 0 1\n";
        const cv::Matx33d turned(0, -1, 0, 1, 0, 0, 0, 0, 1);
        truth.poses.push_back(
            {timestamp, fild::FramePose{turned, turned * way[i] + cv::Vec3d(100, 200, 0)}});
    }
    write_text(run.path("trajectory_optimized.tum"), optimized);
    fild::write_html_report(run.path(), {}, truth);
    const auto laid = fild::testing::data_of_page(run.path("report.html"))["trajectories"]["truth"];
    for (std::size_t i = 0; i < way.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(laid[i][static_cast<std::size_t>(axis)].get<double>(), way[i][axis], 1e-3);
}

TEST(HtmlReport, TellsHowFarEdgesAreFromTheTrajectory)
{
    fild::LoopRow edge;
    edge.position = {1, 0, 0};  // the query is 1 m ahead of the candidate
    edge.angles = {0, 0, 0};
    edge.position_deviations = {0.3, 0.4, 0};
    edge.angle_deviations = {0.01, 0.01, 0.01};
    edge.weight = 1;
    edge.edge = "used";
    const RunFolderFiles run({frame_at(0), loop_at(1, 0)}, {edge});
    // The candidate looks along y, so 1 m ahead of it is (5, 1); the quaternion is a yaw of 90
    // degrees.
    const std::string pose_0 = "1000.000000 5 0 0 0 0 0.707106781 0.707106781\n";
    write_text(run.path("trajectory_input.tum"),
               pose_0 + "1000.100000 5 4 0 0 0 0.707106781 0.707106781\n");
    write_text(run.path("trajectory_optimized.tum"), pose_0 + "1000.100000 5 1 0 0 0 0 1\n");
    const auto data = report_of(run);
    const auto& loop = data["loops"][0];
    EXPECT_NEAR(loop["residual_before_m"].get<double>(), 3, 1e-4);
    EXPECT_NEAR(loop["residual_before_deg"].get<double>(), 0, 1e-2);
    EXPECT_NEAR(loop["residual_after_m"].get<double>(), 0, 1e-4);
    EXPECT_NEAR(loop["residual_after_deg"].get<double>(), 90, 1e-2);
    EXPECT_NEAR(loop["translation_sd_m"].get<double>(), 0.5, 1e-4);
    EXPECT_EQ(data["trajectories"]["input"][1], (std::vector<double>{5, 4, 0}));
}

/** Frame i of a way with a bend, in steps of 4 m. */
fild::FramePose pose_on_way(std::size_t i)
{
    const double yaw = 0.1 * static_cast<double>(i);
    const cv::Matx33d rotation(
        std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1);
    return {rotation, {40 * std::sin(yaw), 40 * (1 - std::cos(yaw)), 0}};
}

std::string tum_line(double timestamp, const fild::FramePose& pose, double turned_by = 0)
{
    const double yaw = std::atan2(pose.rotation(1, 0), pose.rotation(0, 0)) + turned_by;
    std::string line = std::to_string(timestamp);
    for (int axis = 0; axis < 3; ++axis) line += " " + std::to_string(pose.position[axis]);
    return line + " 0 0 " + std::to_string(std::sin(yaw / 2)) + " " +
           std::to_string(std::cos(yaw / 2)) + "\n";
}

/** An edge that is exact, on a map whose headings are off by 2 degrees at the one frame of the edge
 *  and by -2 degrees at all others. \param body  axes of the true poses, seen from the robot's. */
nlohmann::json exact_edge_on_a_bent_map(const cv::Matx33d& body, bool oriented = true)
{
    std::vector<fild::FrameVerdict> frames;
    for (std::size_t i = 0; i < 20; ++i) frames.push_back(i == 19 ? loop_at(19, 3) : frame_at(i));
    const auto candidate = pose_on_way(3);
    const auto query = pose_on_way(19);
    const cv::Vec3d position = candidate.rotation.t() * (query.position - candidate.position);
    fild::LoopRow edge;
    edge.position = {position[0], position[1], 0};
    edge.angles = {1.6, 0, 0};
    const RunFolderFiles run(frames, {edge});
    std::string optimized;
    fild::ReportTruth truth;
    truth.oriented = oriented;
    for (std::size_t i = 0; i < 20; ++i)
    {
        auto pose = pose_on_way(i);
        optimized += tum_line(frame_at(i).timestamp, pose, i == 3 ? 0.035 : -0.002);
        pose.rotation = pose.rotation * body;
        truth.poses.push_back({frame_at(i).timestamp, pose});
    }
    write_text(run.path("trajectory_optimized.tum"), optimized);
    fild::write_html_report(run.path(), {}, truth);
    return data_of_page(run.path("report.html"))["loops"][0];
}

TEST(HtmlReport, JudgesEachEdgeByItself)
{
    const cv::Matx33d same = cv::Matx33d::eye();
    const cv::Matx33d camera(0, 0, 1, -1, 0, 0, 0, -1, 0);
    for (const auto& body : {same, camera})
        EXPECT_NEAR(exact_edge_on_a_bent_map(body)["truth_error_m"].get<double>(), 0, 2e-4) << body;
    EXPECT_FALSE(exact_edge_on_a_bent_map(same, false).contains("truth_error_m"))
        << "headings out of the motion are too rough";
}

/** Of loop closures 3-0 right, 4-1 doubtful, 5-0 wrong; 6 comes back to 2 and is rejected. */
fild::ReportTruth truth_of_seven_frames()
{
    fild::RunResults results;
    results.frames = {frame_at(0),
                      frame_at(1),
                      frame_at(2),
                      loop_at(3, 0),
                      loop_at(4, 1),
                      loop_at(5, 0),
                      rejected_at(6, 1, 0.5)};
    fild::LoopLabels labels = fild::to_loop_labels({{3, 0}, {5, 2}, {6, 2}}, 7);
    labels.doubtful = {{4, 1}};
    fild::ReportTruth truth;
    truth.evaluation = fild::evaluate_loops(results, fild::LabelTruth(labels, 0));
    fild::LoopScore by_window;
    by_window.loop_queries = 3;
    by_window.accepted = by_window.right = 3;
    truth.other_protocols = {{fild::parse_protocol("window:10"), by_window}};
    return truth;
}

TEST(HtmlReport, TellsWrongFromRightMissedAndDoubtful)
{
    const auto truth = truth_of_seven_frames();
    std::vector<fild::FrameVerdict> frames;
    for (const auto& judged : truth.evaluation.frames) frames.push_back(judged.verdict);
    const RunFolderFiles run(frames);
    fild::write_html_report(run.path(), {}, truth);
    const auto data = data_of_page(run.path("report.html"));
    const nlohmann::json none;
    EXPECT_EQ(data["truth"]["judgement"],
              nlohmann::json({none, none, none, "right", "doubtful", "wrong", "wrong"}));
    ASSERT_EQ(data["truth"]["missed"].size(), 2U);
    EXPECT_EQ(data["truth"]["missed"][0]["frame"], 5);
    EXPECT_EQ(data["truth"]["missed"][1]["place"], 2);
    ASSERT_EQ(data["protocols"].size(), 2U);
    EXPECT_EQ(data["protocols"][0]["name"], "exact");
    EXPECT_EQ(data["protocols"][0]["precision"], "0.500");
    EXPECT_EQ(data["protocols"][1]["precision"], "1.000");
    EXPECT_THAT(data["protocols"][1]["rule"].get<std::string>(), HasSubstr("10 frames"));
}

TEST(HtmlReport, ShowsWrongLoopsBeforeAllOthers)
{
    const auto truth = truth_of_seven_frames();
    std::vector<fild::FrameVerdict> frames;
    for (const auto& judged : truth.evaluation.frames) frames.push_back(judged.verdict);
    const RunFolderFiles run(frames);
    for (std::size_t i = 3; i < frames.size(); ++i) run.add_match_picture(frames[i]);
    fild::TReportOptions options;
    options.max_pictures = 1;
    fild::write_html_report(run.path(), options, truth);
    EXPECT_TRUE(data_of_page(run.path("report.html"))["pictures"].contains("5_0"));
}

TEST(HtmlReport, NamesTheFileThatIsMissingOrCutOff)
{
    const RunFolderFiles run(two_laps());
    EXPECT_THAT(fild::testing::message_of<std::runtime_error>(
                    [] { fild::write_html_report("no/such/run", {}); }),
                HasSubstr("no/such/run/summary.json"));

    const auto frames = read_text(run.path("frames.csv"));
    for (const auto lost :
         {std::size_t{10}, frames.size() - frames.rfind('\n', frames.size() - 2) - 1})
    {
        write_text(run.path("frames.csv"), frames.substr(0, frames.size() - lost));
        EXPECT_THAT(error_of(run), HasSubstr(run.path("frames.csv"))) << lost;
    }
    write_text(run.path("frames.csv"), frames);

    const auto loops = read_text(run.path("loops.csv"));
    write_text(run.path("loops.csv"), loops.substr(0, loops.size() - 5));
    EXPECT_THAT(error_of(run), HasSubstr(run.path("loops.csv")));
    write_text(run.path("loops.csv"), loops.substr(0, loops.find('\n') + 1));
    EXPECT_THAT(error_of(run), HasSubstr(run.path("loops.csv")));
    write_text(run.path("loops.csv"), loops);

    write_text(run.path("costs.csv"), "frame,hashing_ms,map_bytes,resident_bytes\n0,1.5,");
    EXPECT_THAT(error_of(run), HasSubstr(run.path("costs.csv")));
    std::string costs = "frame,hashing_ms\n";
    for (int frame = 0; frame < 5000; ++frame) costs += std::to_string(frame) + ",1.5\n";
    write_text(run.path("costs.csv"), costs + "5000,1.5,2\n");
    EXPECT_THAT(error_of(run), HasSubstr("costs.csv line 5002"));
    write_text(run.path("costs.csv"), costs + "5000,slow\n");
    EXPECT_THAT(error_of(run), HasSubstr("costs.csv line 5002"));
    std::filesystem::remove(run.path("costs.csv"));

    std::filesystem::create_directories(run.path("matches"));
    write_text(run.path("matches/2_0.jpg"), "no picture");
    EXPECT_THAT(error_of(run), HasSubstr("matches/2_0.jpg"));
    std::filesystem::remove_all(run.path("matches"));

    write_text(run.path("summary.json"), "{\"rawlog\":");
    EXPECT_THAT(error_of(run), HasSubstr(run.path("summary.json")));
    EXPECT_FALSE(std::filesystem::exists(run.path("report.html")));
}

TEST(HtmlComparison, HoldsBothRunsAndPicturesOfWhatDiffers)
{
    const RunFolderFiles first(two_laps());
    const RunFolderFiles second({frame_at(0), frame_at(1), loop_at(2, 0), rejected_at(3, 0, 0.5)});
    for (const auto* run : {&first, &second}) run->add_match_picture(loop_at(2, 0));
    first.add_match_picture(loop_at(3, 1));
    second.add_match_picture(rejected_at(3, 0, 0.5));
    const auto page = first.path("comparison.html");
    fild::write_html_comparison({first.path(), {}}, {second.path(), {}}, {}, page);
    const auto runs = data_of_page(page)["runs"];
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0]["folder"], first.path());
    EXPECT_EQ(runs[0]["pictures"].size(), 1U);  // not of frame 2, which both have
    EXPECT_TRUE(runs[0]["pictures"].contains("3_1"));
    EXPECT_TRUE(runs[1]["pictures"].contains("3_0"));
}

TEST(HtmlComparison, RefusesRunsOfDifferentRecordings)
{
    const RunFolderFiles first(two_laps());
    auto frames = two_laps();
    frames[1].timestamp += 0.05;
    const RunFolderFiles second(frames);
    EXPECT_THAT(fild::testing::message_of<std::runtime_error>(
                    [&]
                    {
                        fild::write_html_comparison(
                            {first.path(), {}}, {second.path(), {}}, {}, first.path("page.html"));
                    }),
                AllOf(HasSubstr(first.path()), HasSubstr(second.path()), HasSubstr("frame 1")));
}

}  // namespace
