// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_labels.h"
#include "fild/report/html_report.h"
#include "run_folder_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

namespace
{
using fild::testing::data_of_page;
using fild::testing::frame_at;
using fild::testing::loop_at;
using fild::testing::rejected_at;
using fild::testing::RunFolderFiles;
using fild::testing::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::size_t kLongRun = 45000;
constexpr std::size_t kLongLap = 22500;

/** Two laps; of the second, each frame whose number is a multiple of `step` is a loop closure. */
std::vector<fild::FrameVerdict> two_long_laps(std::size_t step)
{
    std::vector<fild::FrameVerdict> frames;
    for (std::size_t i = 0; i < kLongRun; ++i)
        frames.push_back(i < kLongLap    ? frame_at(i)
                         : i % step == 0 ? loop_at(i, i - kLongLap)
                                         : rejected_at(i, i - kLongLap, 0.5));
    return frames;
}

nlohmann::json page_of(const RunFolderFiles& run,
                       const std::optional<fild::ReportTruth>& truth = std::nullopt)
{
    fild::write_html_report(run.path(), {}, truth);
    return data_of_page(run.path("report.html"));
}

std::set<std::size_t> frames_in(const nlohmann::json& page)
{
    const auto numbers = page["frames"]["number"].get<std::vector<std::size_t>>();
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    return {numbers.begin(), numbers.end()};
}

TEST(ReportOfALongRun, HoldsEachLoopAndSomeOfTheOtherFrames)
{
    const RunFolderFiles run(two_long_laps(100));
    run.add_match_picture(rejected_at(kLongLap + 1, 1, 0.5));
    std::string trajectory;
    for (std::size_t i = 0; i < kLongRun; ++i)
        trajectory +=
            std::to_string(frame_at(i).timestamp) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
    write_text(run.path("trajectory_input.tum"), trajectory);
    const auto page = page_of(run);
    const auto frames = frames_in(page);
    EXPECT_GE(frames.size(), 20000U);
    EXPECT_LE(frames.size(), 20300U);
    EXPECT_EQ(page["loops"].size(), 225U);
    for (std::size_t i = kLongLap; i < kLongRun; i += 100)
        EXPECT_TRUE(frames.count(i) == 1 && frames.count(i - kLongLap) == 1) << i;
    for (const auto frame : {std::size_t{0}, std::size_t{1}, kLongLap + 1, kLongRun - 1})
        EXPECT_EQ(frames.count(frame), 1U) << frame << ", an end or with a picture";
    std::size_t widest = 0;
    for (auto i = frames.begin(); std::next(i) != frames.end(); ++i)
        widest = std::max(widest, *std::next(i) - *i);
    EXPECT_LE(widest, 4U) << "evenly";
    EXPECT_EQ(page["frames"]["timestamp"].size(), frames.size());
    ASSERT_EQ(page["trajectories"]["input"].size(), frames.size());
    std::size_t row = 0;
    for (const auto frame : frames)
        ASSERT_EQ(page["trajectories"]["input"][row++][0], static_cast<double>(frame));
}

TEST(ReportOfALongRun, CountsAllFramesAndSaysWhatItHolds)
{
    const RunFolderFiles run(two_long_laps(100));
    const auto page = page_of(run);
    EXPECT_EQ(page["frame_count"], kLongRun);
    EXPECT_EQ(
        page["verdicts"],
        nlohmann::json(
            {{"accepted", 225}, {"too_early", kLongLap}, {"too_few_inliers", kLongLap - 225}}));
    EXPECT_THAT(page["remarks"].back().get<std::string>(),
                AllOf(HasSubstr(std::to_string(frames_in(page).size()) + " of 45000 frames"),
                      HasSubstr("all 225 loop closures"),
                      HasSubstr("of 44775 other frames"),
                      HasSubstr("frames.csv")));
}

TEST(ReportOfALongRun, LeavesRoomForOtherFramesWhereMostAreLoops)
{
    const RunFolderFiles run(two_long_laps(1));
    const auto page = page_of(run);
    EXPECT_EQ(page["loops"].size(), 15000U);
    EXPECT_LE(frames_in(page).size(), 35000U);
    EXPECT_THAT(page["remarks"].back().get<std::string>(),
                HasSubstr("15000 of 22500 loop closures"));
    EXPECT_LT(std::filesystem::file_size(run.path("report.html")), 15e6);
}

TEST(ReportOfALongRun, HoldsWrongAndMissedLoops)
{
    auto verdicts = two_long_laps(1);
    verdicts[kLongLap + 7] = loop_at(kLongLap + 7, 20000);
    verdicts[kLongLap + 13] = rejected_at(kLongLap + 13, 13, 0.5);
    fild::RunResults results;
    results.frames = verdicts;
    std::vector<std::pair<std::size_t, std::size_t>> loops;
    for (std::size_t i = kLongLap; i < kLongRun; ++i) loops.push_back({i, i - kLongLap});
    fild::ReportTruth truth;
    truth.evaluation =
        fild::evaluate_loops(results, fild::LabelTruth(fild::to_loop_labels(loops, kLongRun), 0));
    const RunFolderFiles run(verdicts);
    const auto page = page_of(run, truth);
    const auto frames = frames_in(page);
    EXPECT_EQ(frames.count(kLongLap + 7), 1U);
    EXPECT_EQ(frames.count(20000), 1U) << "where it was taken for";
    ASSERT_EQ(page["truth"]["judgement"].size(), frames.size());
    const auto row = std::distance(frames.begin(), frames.find(kLongLap + 7));
    EXPECT_EQ(page["truth"]["judgement"][static_cast<std::size_t>(row)], "wrong");
    EXPECT_EQ(page["truth"]["missed"].size(), 2U);
    EXPECT_THAT(page["remarks"].back().get<std::string>(),
                HasSubstr(": 1 wrong loop closure, 1 missed loop, "));
}

TEST(ReportOfALongRun, ComparesTheSameFramesOfBothRuns)
{
    const RunFolderFiles first(two_long_laps(100));
    const RunFolderFiles second(two_long_laps(150));
    const auto path = first.path("comparison.html");
    fild::write_html_comparison({first.path(), {}}, {second.path(), {}}, {}, path);
    const auto page = data_of_page(path);
    EXPECT_EQ(page["only"], nlohmann::json({150, 75}));
    const auto frames = frames_in(page["runs"][0]);
    EXPECT_EQ(frames, frames_in(page["runs"][1]));
    EXPECT_EQ(frames.count(kLongLap + 100), 1U);
    EXPECT_EQ(frames.count(kLongLap + 150), 1U);
}

TEST(ReportOfALongRun, HoldsAllOfAShorterOne)
{
    auto frames = two_long_laps(100);
    frames.resize(20000);
    const RunFolderFiles run(frames);
    const auto page = page_of(run);
    EXPECT_EQ(page["frames"]["timestamp"].size(), 20000U);
    EXPECT_FALSE(page["frames"].contains("number"));
    EXPECT_TRUE(page["remarks"].empty());
}

}  // namespace
