// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/loops_csv.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <locale>
#include <string>
#include <vector>

namespace
{
constexpr const char* kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support,depth_source\n";

std::string csv_of(const std::vector<fild::FrameVerdict>& verdicts)
{
    const fild::testing::TemporaryFolder folder;
    fild::CsvWriter<fild::FrameRow> csv(folder.path("frames.csv"), fild::frames_csv_columns());
    for (const auto& verdict : verdicts) csv.add({verdict, "stereo"});
    csv.commit();
    return fild::testing::read_text(folder.path("frames.csv"));
}

TEST(FramesCsv, IsAHeaderWithoutVerdicts)
{
    EXPECT_EQ(csv_of({}), kHeader);
}

TEST(FramesCsv, WritesAnAcceptedLoop)
{
    fild::FrameVerdict verdict;
    verdict.frame = fild::FrameId{45};
    verdict.timestamp = 1226322307.261530;
    verdict.sensor_label = "CAMERA_LEFT";
    verdict.keypoints = 2050;
    verdict.candidate = fild::Candidate{fild::FrameId{3}, 0.9123456789};
    verdict.matches = 200;
    verdict.inliers = 186;
    EXPECT_EQ(csv_of({verdict}),
              std::string(kHeader) +
                  "45,1226322307.261530,CAMERA_LEFT,2050,3,0.912346,200,186,1,,0.000000,stereo\n");
}

TEST(FramesCsv, LeavesTheCandidateEmptyWhenThereIsNone)
{
    fild::FrameVerdict verdict;
    verdict.rejection = fild::Rejection::too_early;
    EXPECT_EQ(csv_of({verdict}),
              std::string(kHeader) + "0,0.000000,,0,,,0,0,0,too_early,0.000000,stereo\n");
}

TEST(FramesCsv, QuotesLabelsThatNeedIt)
{
    fild::FrameVerdict verdict;
    verdict.sensor_label = "left, \"front\"";
    verdict.rejection = fild::Rejection::too_early;
    EXPECT_EQ(csv_of({verdict}),
              std::string(kHeader) +
                  "0,0.000000,\"left, \"\"front\"\"\",0,,,0,0,0,too_early,0.000000,stereo\n");
}

/** Numbers as in `1.234.567`. */
class GroupedDigits : public std::numpunct<char>
{
 protected:
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

// A program with a window sets the user's locale.
TEST(FramesCsv, IsTheSameInAnyLocale)
{
    fild::FrameVerdict verdict;
    verdict.frame = fild::FrameId{12345};
    verdict.timestamp = 1226322307.26153;
    verdict.rejection = fild::Rejection::too_early;
    const auto expected = csv_of({verdict});
    const auto before = std::locale::global(std::locale(std::locale(), new GroupedDigits));
    const auto grouped = csv_of({verdict});
    std::locale::global(before);
    EXPECT_EQ(grouped, expected);
}

std::string text_of(const fild::CsvColumns<fild::LoopRow>& columns,
                    const std::vector<fild::LoopRow>& rows)
{
    const fild::testing::TemporaryFolder folder;
    fild::CsvWriter<fild::LoopRow> csv(folder.path("loops.csv"), columns);
    for (const auto& row : rows) csv.add(row);
    csv.commit();
    return fild::testing::read_text(folder.path("loops.csv"));
}

fild::LoopRow loop_row()
{
    fild::LoopRow row;
    row.verdict.frame = fild::FrameId{45};
    row.verdict.candidate = fild::Candidate{fild::FrameId{3}, 0.5};
    row.depth_source = "stereo";
    return row;
}

std::string line_of(const fild::LoopRow& row)
{
    const auto text = text_of(fild::loops_csv_columns(), {row});
    return text.substr(text.find('\n') + 1);
}

TEST(LoopsCsv, EndsWithPoseDeviationsAndWeight)
{
    auto loop = loop_row();
    loop.position = {1, -2, 0.5};
    loop.angles = {3.14159265358979, 0, -0.01745329252};
    loop.position_deviations = {0.01, 0.02, 0.03};
    loop.angle_deviations = {0.01745329252, 0.0349065850, 0};
    loop.weight = 1;
    loop.edge = "used";
    EXPECT_EQ(line_of(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,1.000000,-2.000000,0.500000,"
              "180.000000,0.000000,-1.000000,0.010000,0.020000,0.030000,1.000000,2.000000,"
              "0.000000,1.000000,used,,,\n");
}

TEST(LoopsCsv, TellsRotationAndDirectionWhereTheScaleIsUnknown)
{
    auto loop = loop_row();
    loop.angles = {3.14159265358979, 0, 0};
    loop.direction = {0, 0.6, -0.8};
    loop.edge = "no_odometry";
    EXPECT_EQ(line_of(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,,,,180.000000,0.000000,0.000000,"
              ",,,,,,,no_odometry,0.000000,0.600000,-0.800000\n");
}

TEST(LoopsCsv, LeavesEmptyWhatIsNotKnown)
{
    auto loop = loop_row();
    loop.edge = "no_depth";
    EXPECT_EQ(line_of(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,,,,,,,,,,,,,,no_depth,,,\n");
    const auto header = text_of(fild::loops_csv_columns(), {});
    const auto row = line_of(loop);
    EXPECT_EQ(std::count(header.begin(), header.end(), ','),
              std::count(row.begin(), row.end(), ','));
}

std::vector<fild::LoopRow> read(const std::string& text)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("loops.csv"), text);
    return fild::read_loops_csv(folder.path("loops.csv"));
}

TEST(ReadLoopsCsv, ReadsWhatIsWritten)
{
    auto scaled = loop_row();
    scaled.position = {1, -2, 0.5};
    scaled.angles = {0.25, 0, -0.125};
    scaled.position_deviations = {0.5, 0.25, 0.125};
    scaled.angle_deviations = {0.01, 0.02, 0.03};
    scaled.weight = 0.75;
    scaled.edge = "used";
    auto unscaled = loop_row();
    unscaled.angles = {1, 0, 0};
    unscaled.direction = {0, 0.6, -0.8};
    const auto text = text_of(fild::loops_csv_columns(), {scaled, unscaled});
    const auto rows = read(text);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].position, scaled.position);
    EXPECT_NEAR(rows[0].angles->at(2), -0.125, 1e-6);
    EXPECT_EQ(rows[0].position_deviations, scaled.position_deviations);
    EXPECT_NEAR(rows[0].angle_deviations->at(0), 0.01, 1e-6);
    EXPECT_EQ(rows[0].weight, 0.75);
    EXPECT_EQ(rows[0].edge, "used");
    EXPECT_FALSE(rows[0].direction);
    EXPECT_FALSE(rows[1].position);
    EXPECT_FALSE(rows[1].weight);
    EXPECT_EQ(rows[1].direction, unscaled.direction);
    EXPECT_EQ(text_of(fild::loops_csv_columns(), rows), text);
}

TEST(ReadLoopsCsv, RefusesAPartOfAVector)
{
    const std::string header =
        "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
        "rejection,support,x,y,z\n1,0,C,9,0,0.5,9,9,1,,0,";
    EXPECT_EQ(read(header + "1,2,3\n").at(0).position, (fild::LoopRow::Three{1, 2, 3}));
    EXPECT_FALSE(read(header + ",,\n").at(0).position);
    for (const auto* part : {"1,2,\n", ",2,3\n", "1,,3\n"})
        EXPECT_THAT(fild::testing::message_of<std::runtime_error>([&] { read(header + part); }),
                    ::testing::HasSubstr("loops.csv line 2"))
            << part;
}

}  // namespace
