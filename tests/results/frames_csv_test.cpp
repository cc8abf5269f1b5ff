// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/frames_csv.h"

#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

const std::string kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support\n";

std::vector<fild::FrameVerdict> read(const std::string& text)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("frames.csv"), text);
    return fild::read_frames_csv(folder.path("frames.csv"));
}

std::string error_of(const std::string& rows)
{
    return message_of<std::runtime_error>([&] { read(kHeader + rows); });
}

TEST(ReadFramesCsv, ReadsWhatTheReportWrites)
{
    fild::FrameVerdict first;
    first.timestamp = 1226322307.261530;
    first.sensor_label = "left, \"front\"\nupper\n";
    first.rejection = fild::Rejection::too_early;
    fild::FrameVerdict second = first;
    second.frame = fild::FrameId{1};
    second.keypoints = 2050;
    second.candidate = fild::Candidate{fild::FrameId{0}, -0.25};
    second.matches = 200;
    second.inliers = 186;
    second.rejection = fild::Rejection::none;
    const fild::testing::TemporaryFolder folder;
    fild::CsvWriter<fild::FrameRow> csv(folder.path("frames.csv"), fild::frames_csv_columns());
    csv.add({first, "stereo"});
    csv.add({second, "none"});
    csv.commit();

    const auto frames = fild::read_frames_csv(folder.path("frames.csv"));
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].sensor_label, first.sensor_label);
    EXPECT_NEAR(frames[0].timestamp, first.timestamp, 1e-6);
    EXPECT_EQ(frames[0].rejection, fild::Rejection::too_early);
    EXPECT_FALSE(frames[0].candidate);
    EXPECT_TRUE(frames[1].accepted());
    EXPECT_EQ(frames[1].frame, fild::FrameId{1});
    EXPECT_EQ(frames[1].candidate->frame, fild::FrameId{0});
    EXPECT_DOUBLE_EQ(frames[1].candidate->similarity, -0.25);
    EXPECT_EQ(frames[1].keypoints, 2050U);
    EXPECT_EQ(frames[1].matches, 200U);
    EXPECT_EQ(frames[1].inliers, 186U);
}

// frames.csv had no depth_source before, and may get further columns.
TEST(ReadFramesCsv, ReadsFilesWithFewerAndWithMoreColumns)
{
    const std::string header =
        "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
        "rejection,support";
    const std::string row = "0,0,C,10,,,0,0,0,too_early,0";
    EXPECT_EQ(read(header + "\n" + row + "\n").size(), 1U);
    EXPECT_EQ(read(header + ",depth_source,more\n" + row + ",stereo,\n").size(), 1U);
    EXPECT_EQ(read("more," + header + "\n," + row + "\n").size(), 1U) << "in any order";
    EXPECT_THROW(read(header + ",depth_source\n" + row + "\n"), std::runtime_error);
    EXPECT_THROW(read(header + "s\n" + row + "\n"), std::runtime_error);
}

TEST(ReadFramesCsv, RefusesWhatIsNoFramesCsv)
{
    EXPECT_THAT(message_of<std::runtime_error>([] { fild::read_frames_csv("no/such/frames.csv"); }),
                HasSubstr("no/such/frames.csv"));
    EXPECT_THAT(message_of<std::runtime_error>([] { read("frame,candidate\n0,0\n"); }),
                HasSubstr("header"));
    EXPECT_THAT(message_of<std::runtime_error>([] { read(""); }), HasSubstr("frames.csv"));
    EXPECT_THAT(error_of(""), HasSubstr("no frame"));
}

TEST(ReadFramesCsv, RefusesRowsThatAreNoVerdicts)
{
    const std::string good = "0,0,C,10,,,0,0,0,too_early,0\n";
    EXPECT_THAT(error_of(good + "1,1,C,10,0\n"), HasSubstr("line 3: 5 columns"));
    EXPECT_THAT(error_of(good + "2,1,C,10,,,0,0,0,too_early,0\n"),
                HasSubstr("frame 1 is expected"));
    EXPECT_THAT(error_of("0,now,C,10,,,0,0,0,too_early,0\n"), HasSubstr("'now' is not a number"));
    EXPECT_THAT(error_of("0,0,C,10,,,0,0,0,dull,0\n"), HasSubstr("'dull'"));
    EXPECT_THAT(error_of("0,0,C,10,,,0,0,1,too_early,0\n"), HasSubstr("contradicts"));
    EXPECT_THAT(error_of("0,0,C,10,,,0,0,1,,0\n"), HasSubstr("without a candidate"));
    EXPECT_THAT(error_of(good + "1,1,C,10,1,0.5,9,9,1,,0\n"), HasSubstr("not an earlier frame"));
}

}  // namespace
