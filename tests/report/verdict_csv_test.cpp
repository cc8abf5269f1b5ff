// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/verdict_csv.h"

#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <locale>

namespace
{
constexpr const char* kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support,depth_source\n";

std::string csv_of(const std::vector<fild::FrameVerdict>& verdicts)
{
    const fild::testing::TemporaryFolder folder;
    fild::VerdictCsv csv(folder.path("frames.csv"));
    for (const auto& verdict : verdicts) csv.add(verdict, "stereo");
    csv.commit();
    return fild::testing::read_text(folder.path("frames.csv"));
}

TEST(VerdictCsv, IsAHeaderWithoutVerdicts)
{
    EXPECT_EQ(csv_of({}), kHeader);
}

TEST(VerdictCsv, WritesAnAcceptedLoop)
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

TEST(VerdictCsv, LeavesTheCandidateEmptyWhenThereIsNone)
{
    fild::FrameVerdict verdict;
    verdict.rejection = fild::Rejection::too_early;
    EXPECT_EQ(csv_of({verdict}),
              std::string(kHeader) + "0,0.000000,,0,,,0,0,0,too_early,0.000000,stereo\n");
}

TEST(VerdictCsv, QuotesLabelsThatNeedIt)
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
TEST(VerdictCsv, IsTheSameInAnyLocale)
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

std::string loop_csv_row(const fild::LoopRow& loop)
{
    fild::FrameVerdict verdict;
    verdict.frame = fild::FrameId{45};
    verdict.candidate = fild::Candidate{fild::FrameId{3}, 0.5};
    const fild::testing::TemporaryFolder folder;
    fild::LoopCsv csv(folder.path("loops.csv"));
    csv.add(verdict, "stereo", loop);
    csv.commit();
    const auto text = fild::testing::read_text(folder.path("loops.csv"));
    return text.substr(text.find('\n') + 1);
}

TEST(LoopCsv, EndsWithPoseDeviationsAndWeight)
{
    fild::LoopRow loop;
    loop.candidate_from_query = {1, -2, 0.5, 3.14159265358979, 0, -0.01745329252};
    loop.deviations = {0.01, 0.02, 0.03, 0.01745329252, 0.0349065850, 0};
    loop.weight = 1;
    loop.edge = "used";
    EXPECT_EQ(loop_csv_row(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,1.000000,-2.000000,0.500000,"
              "180.000000,0.000000,-1.000000,0.010000,0.020000,0.030000,1.000000,2.000000,"
              "0.000000,1.000000,used,,,\n");
}

TEST(LoopCsv, TellsRotationAndDirectionWhereTheScaleIsUnknown)
{
    fild::LoopRow loop;
    loop.unscaled = {{3.14159265358979, 0, 0}, {0, 0.6, -0.8}};
    loop.edge = "no_odometry";
    EXPECT_EQ(loop_csv_row(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,,,,180.000000,0.000000,0.000000,"
              ",,,,,,,no_odometry,0.000000,0.600000,-0.800000\n");
}

TEST(LoopCsv, LeavesEmptyWhatIsNotKnown)
{
    fild::LoopRow loop;
    loop.edge = "no_depth";
    EXPECT_EQ(loop_csv_row(loop),
              "45,0.000000,,0,3,0.500000,0,0,1,,0.000000,stereo,,,,,,,,,,,,,,no_depth,,,\n");
    const fild::testing::TemporaryFolder folder;
    fild::LoopCsv csv(folder.path("loops.csv"));
    csv.commit();
    const auto header = fild::testing::read_text(folder.path("loops.csv"));
    const auto row = loop_csv_row(loop);
    EXPECT_EQ(std::count(header.begin(), header.end(), ','),
              std::count(row.begin(), row.end(), ','));
}

}  // namespace
