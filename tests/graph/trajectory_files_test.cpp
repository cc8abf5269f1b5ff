// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory_files.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <filesystem>

namespace
{
using fild::FrameId;
using fild::TrajectoryFormat;
using fild::write_trajectory;
using fild::testing::message_of;
using fild::testing::read_text;
using fild::testing::TemporaryFolder;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;

std::vector<fild::TrajectoryPose> two_poses(std::uint64_t second_frame = 1)
{
    return {
        {FrameId{0}, 1577836800.25, CPose3D(1, 2, 3, 0, 0, 0), 0},
        {FrameId{second_frame}, 1577836800.5, CPose3D(0.5, -2, 1e-7, 3.14159265358979, 0, 0), 0}};
}

TEST(WriteTrajectory, InTumsFormat)
{
    const TemporaryFolder folder;
    write_trajectory(folder.path("a.tum"), two_poses(7), TrajectoryFormat::tum);
    const auto text = read_text(folder.path("a.tum"));
    EXPECT_THAT(text, HasSubstr("1577836800.25 1 2 3 0 0 0 1\n1577836800.5 0.5 -2 1e-07 0 0 "));
}

TEST(WriteTrajectory, InKittisFormat)
{
    const TemporaryFolder folder;
    write_trajectory(folder.path("a.txt"), two_poses(), TrajectoryFormat::kitti);
    EXPECT_THAT(read_text(folder.path("a.txt")), HasSubstr("1 0 0 1 0 1 0 2 -0 0 1 3\n-1 "));
}

TEST(WriteTrajectory, RefusesKittisFormatWithGaps)
{
    const TemporaryFolder folder;
    EXPECT_THAT(
        message_of<std::runtime_error>(
            [&] { write_trajectory(folder.path("a.txt"), two_poses(2), TrajectoryFormat::kitti); }),
        HasSubstr("frame 1 has no pose"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteTrajectory, NamesTheFileThatCannotBeWritten)
{
    EXPECT_THAT(message_of<std::runtime_error>(
                    [] { write_trajectory("/no/such/folder/a.tum", {}, TrajectoryFormat::tum); }),
                HasSubstr("/no/such/folder/a.tum"));
}

}  // namespace
