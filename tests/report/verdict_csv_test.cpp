// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/verdict_csv.h"

#include "temporary_folder.h"

#include <gtest/gtest.h>

namespace
{
constexpr const char* kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support\n";

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
                  "45,1226322307.261530,CAMERA_LEFT,2050,3,0.912346,200,186,1,,0.000000\n");
}

TEST(VerdictCsv, LeavesTheCandidateEmptyWhenThereIsNone)
{
    fild::FrameVerdict verdict;
    verdict.rejection = fild::Rejection::too_early;
    EXPECT_EQ(csv_of({verdict}),
              std::string(kHeader) + "0,0.000000,,0,,,0,0,0,too_early,0.000000\n");
}

TEST(VerdictCsv, QuotesLabelsThatNeedIt)
{
    fild::FrameVerdict verdict;
    verdict.sensor_label = "left, \"front\"";
    verdict.rejection = fild::Rejection::too_early;
    EXPECT_EQ(
        csv_of({verdict}),
        std::string(kHeader) + "0,0.000000,\"left, \"\"front\"\"\",0,,,0,0,0,too_early,0.000000\n");
}

}  // namespace
