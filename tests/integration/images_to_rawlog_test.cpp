// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "message_of.h"
#include "run_command.h"
#include "temporary_folder.h"

#include <mrpt/obs/CObservation.h>
#include <opencv2/imgcodecs.hpp>

namespace
{
using fild::testing::Finished;
using fild::testing::read_text;
using fild::testing::run_command;
using fild::testing::TemporaryFolder;
using fild::testing::write_text;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/** A folder with three images, where the app is run. */
class ImagesToRawlog : public ::testing::Test
{
 protected:
    ImagesToRawlog()
    {
        fs::create_directory(folder_.path("in"));
        for (const auto* name : {"a.png", "b.png", "c d.png"})
            cv::imwrite(folder_.path("in/") + name, cv::Mat(48, 64, CV_8UC3, cv::Scalar(1, 2, 3)));
    }

    Finished run(const std::string& arguments) const
    {
        return run_command("cd '" + folder_.path() + "' && '" IMAGES_TO_RAWLOG "' " + arguments);
    }

    /** Expects one line on stderr and no output; returns the line. */
    std::string error_of(const std::string& arguments, int exit_code) const
    {
        const auto finished = run(arguments);
        EXPECT_EQ(finished.exit_code, exit_code) << arguments;
        EXPECT_THAT(finished.err, AllOf(StartsWith("images-to-rawlog: "), EndsWith("\n")));
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
        EXPECT_EQ(finished.out, "");
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("run"))) << arguments;
        return finished.err;
    }

    void write(const std::string& name, const std::string& text) const
    {
        write_text(folder_.path(name), text);
    }

    TemporaryFolder folder_;
};

TEST_F(ImagesToRawlog, ShowsHelpAndVersion)
{
    const auto help = run("--help");
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* flag : {"--output",
                             "--images",
                             "--list",
                             "--timestamps",
                             "--rate",
                             "--calib",
                             "--sensor-label",
                             "--embed"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    const auto version = run("--version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, HasSubstr("0.1"));
}

TEST_F(ImagesToRawlog, WritesARawlogThatReadsBack)
{
    write("list.txt", "in/b.png 1\nin/c d.png 2\nin/b.png 3\n");
    write("calib.txt", "50 50 32 24 64 48\n");
    const auto finished =
        run("--list list.txt --calib calib.txt --sensor-label EYE --output run.rawlog");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, "run.rawlog: 3 frames of 2 images, in run_Images\n");
    const auto path = folder_.path("run.rawlog");
    fild::RawlogReader reader(path);
    fild::FrameBuilder builder(fild::TInputOptions(), path);
    double expected_time = 0;
    while (const auto observation = reader.next())
    {
        ASSERT_TRUE(builder.accepts(*observation));
        const auto frame = builder.build(*observation);
        EXPECT_DOUBLE_EQ(frame.timestamp, ++expected_time);
        EXPECT_EQ(frame.sensor_label, "EYE");
        EXPECT_EQ(frame.defect, fild::Rejection::none);
        EXPECT_TRUE(frame.camera);
    }
    EXPECT_EQ(to_index(builder.next_id()), 3U);
}

TEST_F(ImagesToRawlog, EmbedsAFolderOfImages)
{
    write("times.txt", "0\n0.1\n0.2\n");
    const auto finished = run("--images in --timestamps times.txt --embed --output run.rawlog");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, "run.rawlog: 3 frames of 3 images, embedded\n");
    EXPECT_FALSE(fs::exists(folder_.path("run_Images")));
}

TEST_F(ImagesToRawlog, IsReadByMrptsRawlogEdit)
{
    if (run_command("command -v rawlog-edit").exit_code != 0)
        GTEST_SKIP() << "no rawlog-edit (Debian package mrpt-apps)";
    ASSERT_EQ(run("--images in --rate 10 --output run.rawlog").exit_code, 0);
    const auto info =
        run_command("cd '" + folder_.path() + "' && rawlog-edit --info -i run.rawlog");
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_THAT(info.out,
                AllOf(HasSubstr("Overall number of objects         : 3"),
                      HasSubstr("CAMERA1"),
                      HasSubstr("run_Images")));
}

TEST_F(ImagesToRawlog, TellsWrongUsage)
{
    EXPECT_THAT(error_of("", 2),
                AllOf(HasSubstr("--output"), HasSubstr("--images"), HasSubstr("--list")));
    EXPECT_THAT(error_of("--images in --rate 1", 2), HasSubstr("required"));
    EXPECT_THAT(error_of("--images in --list x --rate 1 --output run.rawlog", 2),
                HasSubstr("--list"));
    EXPECT_THAT(error_of("--images in --rate fast --output run.rawlog", 2), HasSubstr("'fast'"));
    EXPECT_THAT(error_of("--images in --rate 0 --output run.rawlog", 2), HasSubstr("rate"));
    EXPECT_THAT(error_of("--images in --bogus --output run.rawlog", 2), HasSubstr("--bogus"));
    EXPECT_THAT(error_of("--images in --rate 1 --output run.rawlog extra", 2), HasSubstr("extra"));
    EXPECT_THAT(error_of("--images in --output run.rawlog", 2), HasSubstr("no time stamps"));
    EXPECT_THAT(error_of("--images in --rate 1 --timestamps t --output run.rawlog", 2),
                HasSubstr("several sources"));
    EXPECT_THAT(error_of("--images in --rate 1 --output run.bag", 2), HasSubstr(".rawlog"));
}

TEST_F(ImagesToRawlog, TellsWhatIsWrongWithTheInput)
{
    const std::string rest = " --rate 1 --output run.rawlog";
    EXPECT_THAT(error_of("--list ''" + rest, 1), HasSubstr("cannot read ''"));
    EXPECT_THAT(error_of("--images none" + rest, 1), HasSubstr("none"));
    EXPECT_THAT(error_of("--list none.txt" + rest, 1), HasSubstr("none.txt"));
    write("list.txt", "in/a.png\nin/zz.png\n");
    EXPECT_THAT(error_of("--list list.txt" + rest, 1),
                AllOf(HasSubstr("in/zz.png"), HasSubstr("list.txt line 2")));
    write("broken.txt", "in/a.png\nbroken.txt\n");
    EXPECT_THAT(error_of("--list broken.txt" + rest, 1), HasSubstr("broken.txt line 2"));
    write("calib.txt", "50 50 32 24 640 480\n");
    EXPECT_THAT(error_of("--images in --calib calib.txt" + rest, 1), HasSubstr("640x480"));
    EXPECT_THAT(error_of("--images in --calib none.txt" + rest, 1), HasSubstr("none.txt"));
    write("times.txt", "0\n1\n");
    EXPECT_THAT(error_of("--images in --timestamps times.txt --output run.rawlog", 1),
                HasSubstr("2 times in times.txt for 3 images"));
    write("times.txt", "0\n1\n1\n");
    EXPECT_THAT(error_of("--images in --timestamps times.txt --output run.rawlog", 1),
                HasSubstr("times.txt line 3"));
    EXPECT_THAT(error_of("--images in --rate 1 --output none/run.rawlog", 1),
                HasSubstr("none/run.rawlog"));
}

TEST_F(ImagesToRawlog, RefusesToReplaceARawlog)
{
    const std::string arguments = "--images in --rate 1 --output run.rawlog";
    ASSERT_EQ(run(arguments).exit_code, 0);
    const auto again = run(arguments);
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_THAT(again.err, HasSubstr("run.rawlog exists already; remove it"));
}

}  // namespace
