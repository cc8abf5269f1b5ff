// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "message_of.h"
#include "run_command.h"
#include "temporary_folder.h"

#include <mrpt/obs/CObservation.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

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

    /** Draws an image with a disc, and makes the folder for it. */
    void draw(const std::string& name, int type = CV_8UC3, int shade = 200) const
    {
        fs::create_directories(fs::path(folder_.path(name)).parent_path());
        cv::Mat image(48, 64, type, cv::Scalar(20, 20, 20));
        cv::circle(image, {30, 20}, 9, cv::Scalar(shade, shade, shade), cv::FILLED);
        cv::imwrite(folder_.path(name), image);
    }

    /** A calibration file for the drawn images. */
    void write_calibration(const std::string& last_line = "") const
    {
        write("calib.txt", "50 50 32 24 64 48\n" + last_line);
    }

    /** Two frames of a KITTI sequence in `kitti`. */
    void draw_kitti(const std::string& cameras) const
    {
        for (const char camera : cameras)
            for (const auto* name : {"/000000.png", "/000001.png"})
                draw(std::string("kitti/image_") + camera + name, CV_8UC1);
        write("kitti/times.txt", "0\n0.1\n");
        write("kitti/calib.txt",
              "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: 50 0 32 -25 0 50 24 0 0 0 1 0\n");
    }

    /** Two frames of a TUM sequence in `tum`, and a colour image that is alone. */
    void draw_tum() const
    {
        for (const auto* name : {"tum/rgb/1.00.png", "tum/rgb/1.03.png", "tum/rgb/1.50.png"})
            draw(name);
        draw("tum/depth/1.01.png", CV_16UC1, 5000);
        draw("tum/depth/1.04.png", CV_16UC1, 6000);
        write("tum/rgb.txt", "# t\n1.00 rgb/1.00.png\n1.03 rgb/1.03.png\n1.50 rgb/1.50.png\n");
        write("tum/depth.txt", "# t\n1.01 depth/1.01.png\n1.04 depth/1.04.png\n");
    }

    /** Frames that the rawlog has, all of them good. */
    std::vector<fild::Frame> frames_of(const std::string& rawlog) const
    {
        const auto path = folder_.path(rawlog);
        fild::RawlogReader reader(path);
        fild::FrameBuilder builder(fild::TInputOptions(), path);
        std::vector<fild::Frame> frames;
        while (const auto observation = reader.next())
        {
            EXPECT_TRUE(builder.accepts(*observation));
            frames.push_back(builder.build(*observation));
            EXPECT_EQ(frames.back().defect, fild::Rejection::none);
        }
        return frames;
    }

    /** Of all observations, each with a blank behind. */
    std::string labels_of(const std::string& rawlog) const
    {
        fild::RawlogReader reader(folder_.path(rawlog));
        std::string labels;
        while (const auto observation = reader.next()) labels += observation->sensorLabel + " ";
        return labels;
    }

    /** What MRPT's rawlog-edit says of a rawlog, and which external images it finds named there. */
    std::string rawlog_edit(const std::string& rawlog) const
    {
        const auto finished = run_command(
            "cd '" + folder_.path() + "' && rawlog-edit --info -i " + rawlog +
            " && rawlog-edit --list-images --text-file-output images.txt -w -i " + rawlog);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished.out + read_text(folder_.path("images.txt"));
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
                             "--format",
                             "--right",
                             "--depth",
                             "--depth-scale",
                             "--sensor-label",
                             "--embed"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    const auto version = run("--version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, HasSubstr("0.1"));
}

TEST_F(ImagesToRawlog, PrintsNothingWhenItIsQuiet)
{
    draw("in/a.png");
    const auto finished = run("--images in --rate 1 --output run.rawlog --quiet");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out + finished.err, "");
}

TEST_F(ImagesToRawlog, RemovesWhatAKilledRunLeft)
{
    draw("in/a.png");
    write("run.rawlog.fild-part-1", "half");
    fs::create_directory(folder_.path("run_Images.fild-part-1"));
    write("run_Images.fild-part-1/b.png", "half");
    write("other.rawlog.fild-part-1", "of another output");
    const auto finished = run("--images in --rate 1 --output run.rawlog");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_FALSE(fs::exists(folder_.path("run.rawlog.fild-part-1")));
    EXPECT_FALSE(fs::exists(folder_.path("run_Images.fild-part-1")));
    EXPECT_TRUE(fs::exists(folder_.path("other.rawlog.fild-part-1")));
    EXPECT_TRUE(fs::exists(folder_.path("run_Images/a.png")));
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
    EXPECT_THAT(error_of("--images in --rate 1", 2), HasSubstr("missing: --output"));
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
    const std::string rest = " --images in --output run.rawlog --format ";
    EXPECT_THAT(error_of(rest + "rosbag", 2), HasSubstr("list|kitti|malaga|newcollege|tum|stereo"));
    EXPECT_THAT(error_of(rest + "kitti --depth in", 2), HasSubstr("--depth does not go with"));
    EXPECT_THAT(error_of(rest + "tum", 2), HasSubstr("needs --calib"));
    EXPECT_THAT(error_of(rest + "stereo --rate 1 --right in", 2), HasSubstr("needs --calib"));
    EXPECT_THAT(error_of(rest + "list --depth in --depth-scale 0 --calib c", 2),
                HasSubstr("--depth-scale must be above 0"));
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

TEST_F(ImagesToRawlog, WritesAKittiSequence)
{
    draw_kitti("01");
    const auto finished = run("--format kitti --images kitti --output run.rawlog");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, "run.rawlog: 2 frames of 4 images, in run_Images\n");
    const auto frames = frames_of("run.rawlog");
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_NEAR(frames[1].timestamp, 0.1, 1e-7);
    ASSERT_TRUE(frames[1].camera);
    EXPECT_EQ(frames[1].camera->fx, 50);
}

TEST_F(ImagesToRawlog, WritesMalagaAndNewCollege)
{
    draw("malaga/CAMERA_LEFT_1226322035.529528.jpg");
    draw("malaga/CAMERA_LEFT_1226322035.662892.jpg");
    draw("malaga/CAMERA_RIGHT_1226322035.533012.jpg");
    draw("college/StereoImage__1225719815.864878-left.pnm", CV_8UC1);
    write_calibration("baseline 0.86\n");
    const auto malaga =
        run("--format malaga --images malaga --calib calib.txt --output malaga.rawlog");
    EXPECT_EQ(malaga.out, "malaga.rawlog: 2 frames of 3 images, in malaga_Images\n") << malaga.err;
    EXPECT_EQ(labels_of("malaga.rawlog"), "CAMERA_LEFT CAMERA_RIGHT CAMERA_LEFT ");
    EXPECT_THAT(
        error_of(
            "--format malaga --images malaga --calib calib.txt --sensor-label A --output x.rawlog",
            2),
        HasSubstr("leave out --sensor-label"));
    const auto college = run("--format newcollege --images college --output college.rawlog");
    EXPECT_EQ(college.out, "college.rawlog: 1 frame of 1 image, in college_Images\n")
        << college.err;
    EXPECT_NEAR(frames_of("college.rawlog").at(0).timestamp, 1225719815.864878, 1e-6);
}

TEST_F(ImagesToRawlog, WritesATumSequenceWithItsGroundTruth)
{
    draw_tum();
    write_calibration();
    write("tum/groundtruth.txt", "# t\n0.5 1 2 3 0 0 0 1\n1.5 4 5 6 -0.5 0.5 -0.5 0.5\n");
    const auto finished =
        run("--format tum --images tum --calib calib.txt --embed --output run.rawlog");
    EXPECT_EQ(finished.out,
              "run.rawlog: 2 frames of 2 images and 2 depth images, embedded\n"
              "ground truth: run.gt.tum\n"
              "left out: 1 colour image without a depth image within 0.02 s\n")
        << finished.err;
    EXPECT_EQ(read_text(folder_.path("run.gt.tum")),
              "0.5 1 2 3 0.5 -0.5 0.5 0.5\n1.5 4 5 6 0 0 0 1\n");
    const auto frames = frames_of("run.rawlog");
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_NEAR(frames[1].timestamp, 1.03, 1e-7);
}

TEST_F(ImagesToRawlog, WritesPairedFolders)
{
    draw("left/1.png");
    draw("right/1.png");
    draw("depth/1.png", CV_16UC1, 1234);
    write_calibration("baseline 0.1");
    const std::string rest = " --images left --rate 1 --calib calib.txt --output ";
    EXPECT_EQ(run("--format stereo --right right" + rest + "stereo.rawlog").out,
              "stereo.rawlog: 1 frame of 2 images, in stereo_Images\n");
    EXPECT_EQ(run("--depth depth --depth-scale 256" + rest + "depth.rawlog").out,
              "depth.rawlog: 1 frame of 1 image and 1 depth image, in depth_Images\n");
    EXPECT_EQ(run("--format list" + rest + "mono.rawlog").exit_code, 0) << "baseline is allowed";
    for (const auto* rawlog : {"stereo.rawlog", "depth.rawlog", "mono.rawlog"})
    {
        const auto frames = frames_of(rawlog);
        ASSERT_EQ(frames.size(), 1U) << rawlog;
        EXPECT_TRUE(frames[0].camera) << rawlog;
    }
}

TEST_F(ImagesToRawlog, WritesStereoAndDepthThatMrptsRawlogEditReads)
{
    if (run_command("command -v rawlog-edit").exit_code != 0)
        GTEST_SKIP() << "no rawlog-edit (Debian package mrpt-apps)";
    draw_kitti("01");
    draw_tum();
    write_calibration();
    ASSERT_EQ(run("--format kitti --images kitti --output stereo.rawlog").exit_code, 0);
    EXPECT_THAT(rawlog_edit("stereo.rawlog"),
                AllOf(HasSubstr("Overall number of objects         : 2"),
                      HasSubstr("stereo_Images"),
                      HasSubstr("000000_left.png\n000000_right.png\n000001_left.png\n")));
    ASSERT_EQ(run("--format tum --images tum --calib calib.txt --output depth.rawlog").exit_code,
              0);
    EXPECT_THAT(rawlog_edit("depth.rawlog"),
                AllOf(HasSubstr("Overall number of objects         : 2"),
                      HasSubstr("depth_Images"),
                      HasSubstr("1.00.png\n1.03.png\n")));
    ASSERT_EQ(run("--images in --rate 10 --output mono.rawlog").exit_code, 0);
    EXPECT_THAT(rawlog_edit("mono.rawlog"), HasSubstr("a.png\nb.png\nc d.png\n"));
}

TEST_F(ImagesToRawlog, TellsWhatIsWrongWithALayout)
{
    const std::string kitti = "--format kitti --images kitti --output run.rawlog";
    fs::create_directory(folder_.path("kitti"));
    EXPECT_THAT(error_of(kitti, 1), HasSubstr("neither image_0 nor image_2"));
    draw_kitti("01");
    fs::remove(folder_.path("kitti/times.txt"));
    EXPECT_THAT(error_of(kitti, 1), HasSubstr("times.txt does not exist"));
    draw_kitti("01");
    fs::remove(folder_.path("kitti/image_1/000001.png"));
    EXPECT_THAT(error_of(kitti, 1), HasSubstr("2 images in"));
    cv::imwrite(folder_.path("kitti/image_1/000001.png"), cv::Mat(40, 60, CV_8UC1));
    EXPECT_THAT(error_of(kitti, 1), AllOf(HasSubstr("60x40"), HasSubstr("64x48")));

    for (const std::string format : {"malaga", "newcollege"})
        EXPECT_THAT(error_of("--images in --output run.rawlog --format " + format, 1),
                    AllOf(HasSubstr("has a name like"), HasSubstr("holds a.png")));

    draw_tum();
    write_calibration();
    const std::string tum = "--format tum --images tum --calib calib.txt --output run.rawlog";
    draw("tum/depth/1.04.png", CV_8UC1);
    EXPECT_THAT(error_of(tum, 1), AllOf(HasSubstr("1.04.png"), HasSubstr("16-bit")));
    cv::imwrite(folder_.path("tum/depth/1.04.png"), cv::Mat(40, 60, CV_16UC1));
    EXPECT_THAT(error_of(tum, 1), AllOf(HasSubstr("1.04.png"), HasSubstr("60x40")));
    fs::remove(folder_.path("tum/depth.txt"));
    EXPECT_THAT(error_of(tum, 1), HasSubstr("no depth.txt"));

    const std::string depth = "--images in --rate 1 --calib calib.txt --output run.rawlog";
    EXPECT_THAT(error_of(depth + " --depth tum/depth", 1), HasSubstr("3 images in in, 2 in tum"));
    EXPECT_THAT(error_of(depth + " --format stereo --right in", 1), HasSubstr("baseline METRES"));
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
