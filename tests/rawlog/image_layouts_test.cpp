// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_layouts.h"

#include "drawn_rawlog.h"
#include "message_of.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <functional>

namespace
{
using namespace fild::testing;
using fild::Calibration;
using fild::ImageLayout;
using fild::LayoutRequest;
using fild::Recording;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fild::TimestampSource kTenHertz{"", 10.0};

Calibration calibration(std::optional<double> baseline_m = std::nullopt)
{
    return {fild::parse_camera_model("50 51 32 24 64 48", "test"), baseline_m};
}

/** Files without content, in a folder of their own. */
void make_files(const TemporaryFolder& folder, const std::vector<std::string>& names)
{
    for (const auto& name : names)
    {
        fs::create_directories(fs::path(folder.path(name)).parent_path());
        write_text(folder.path(name), "");
    }
}

std::string name_of(const fild::ImageFile& file)
{
    return fs::path(file.path).filename().string();
}

template <class Read>
std::string error_of(Read&& read)
{
    return message_of<std::runtime_error>(read);
}

// Stereo folders, images with depth

TEST(StereoFolders, PairsByOrderOfNames)
{
    const TemporaryFolder folder;
    make_files(folder, {"l/2.png", "l/1.png", "r/b.png", "r/a.png"});
    const auto recording =
        fild::read_stereo_folders(folder.path("l"), folder.path("r"), kTenHertz, calibration(0.1));
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_EQ(name_of(recording.frames[1].image), "2.png");
    EXPECT_EQ(name_of(*recording.frames[1].right), "b.png");
    EXPECT_DOUBLE_EQ(recording.frames[1].image.seconds, 0.1);
    EXPECT_FALSE(recording.frames[1].depth);
    EXPECT_EQ(recording.calibration->baseline_m, 0.1);
}

TEST(StereoFolders, WantsAPartnerForEachAndABaseline)
{
    const TemporaryFolder folder;
    make_files(folder, {"l/1.png", "l/2.png", "r/1.png"});
    const auto error = [&](const Calibration& with)
    {
        return error_of(
            [&]
            { fild::read_stereo_folders(folder.path("l"), folder.path("r"), kTenHertz, with); });
    };
    EXPECT_THAT(
        error(calibration(0.1)),
        AllOf(HasSubstr("2 images in " + folder.path("l")), HasSubstr("1 in " + folder.path("r"))));
    EXPECT_THAT(error(calibration()), HasSubstr("'baseline METRES'"));
}

TEST(ImagesWithDepth, PairsByOrder)
{
    const TemporaryFolder folder;
    make_files(folder, {"c/1.jpg", "c/2.jpg", "d/1.png", "d/2.png", "d/3.png"});
    const auto read = [&]
    {
        return fild::read_images_with_depth(
            fild::list_image_folder(folder.path("c")), folder.path("d"), kTenHertz, calibration());
    };
    EXPECT_THAT(error_of(read),
                AllOf(HasSubstr("2 images in " + folder.path("c")), HasSubstr("3 in ")));
    EXPECT_THAT(error_of(
                    [&]
                    {
                        fild::read_images_with_depth(
                            {{{"c/1.jpg", "list.txt line 1"}, std::nullopt}},
                            folder.path("d"),
                            kTenHertz,
                            calibration());
                    }),
                HasSubstr("1 image in the list, 3 in "));
    fs::remove(folder.path("d/1.png"));
    const auto recording = read();
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_EQ(name_of(*recording.frames[0].depth), "2.png");
    EXPECT_EQ(recording.depth_units_per_metre, 1000);
}

// KITTI

constexpr auto kKittiCalibration =
    "P0: 7.0e+02 0 6.0e+02 0 0 7.1e+02 1.8e+02 0 0 0 1 0\n"
    "P1: 7.0e+02 0 6.0e+02 -3.85e+02 0 7.1e+02 1.8e+02 0 0 0 1 0\n"
    "P2: 7.0e+02 0 6.0e+02 4.5e+01 0 7.1e+02 1.8e+02 -1e-01 0 0 1 4e-3\n"
    "P3: 7.0e+02 0 6.0e+02 -3.4e+02 0 7.1e+02 1.8e+02 2.3e+00 0 0 1 4e-3\n"
    "Tr: 0 0 0 0 0 0 0 0 0 0 0 0\n";

/** A KITTI sequence of two frames with the images of these cameras. */
void make_kitti(const TemporaryFolder& folder, const std::string& cameras)
{
    for (const char camera : cameras)
        for (const auto* name : {"000000.png", "000001.png"})
        {
            const auto dir = std::string("image_") + camera + "/";
            fs::create_directories(folder.path(dir));
            cv::imwrite(folder.path(dir + name), draw_image(CV_8UC1, camera, {80, 30}));
        }
    write_text(folder.path("times.txt"), "0.000000e+00\n1.037359e-01\n");
    write_text(folder.path("calib.txt"), kKittiCalibration);
}

Recording read_kitti(const TemporaryFolder& folder,
                     const std::optional<Calibration>& with = std::nullopt)
{
    return fild::read_kitti_layout(folder.path(), {}, with);
}

TEST(KittiLayout, ReadsAGreyStereoSequence)
{
    const TemporaryFolder folder;
    make_kitti(folder, "0123");
    const auto recording = read_kitti(folder);
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_EQ(recording.frames[1].image.path, folder.path("image_0/000001.png"));
    EXPECT_EQ(recording.frames[1].right->path, folder.path("image_1/000001.png"));
    EXPECT_DOUBLE_EQ(recording.frames[1].image.seconds, 0.1037359);
    ASSERT_TRUE(recording.calibration);
    const auto& camera = recording.calibration->camera;
    EXPECT_EQ(camera.fx, 700);
    EXPECT_EQ(camera.fy, 710);
    EXPECT_EQ(camera.cx, 600);
    EXPECT_EQ(camera.cy, 180);
    EXPECT_EQ(camera.width, 80);
    EXPECT_EQ(camera.height, 30);
    EXPECT_EQ(camera.lens, fild::LensModel::none);
    EXPECT_DOUBLE_EQ(*recording.calibration->baseline_m, 0.55);
}

TEST(KittiLayout, TakesColourWithoutGrey)
{
    const TemporaryFolder folder;
    make_kitti(folder, "23");
    const auto recording = read_kitti(folder);
    EXPECT_EQ(recording.frames[0].image.path, folder.path("image_2/000000.png"));
    EXPECT_EQ(recording.frames[0].right->path, folder.path("image_3/000000.png"));
    EXPECT_NEAR(*recording.calibration->baseline_m, (340 + 45) / 700.0, 1e-12);
}

TEST(KittiLayout, ReadsOneCameraWithAndWithoutCalibration)
{
    const TemporaryFolder folder;
    make_kitti(folder, "0");
    auto recording = read_kitti(folder);
    EXPECT_FALSE(recording.frames[0].right);
    EXPECT_EQ(recording.calibration->camera.fx, 700);
    EXPECT_FALSE(recording.calibration->baseline_m);
    EXPECT_EQ(read_kitti(folder, calibration()).calibration->camera.fx, 50) << "replaces calib.txt";
    fs::remove(folder.path("calib.txt"));
    EXPECT_FALSE(read_kitti(folder).calibration);
}

TEST(KittiLayout, TakesOtherTimesAndCalibration)
{
    const TemporaryFolder folder;
    make_kitti(folder, "01");
    fs::remove(folder.path("times.txt"));
    fs::remove(folder.path("calib.txt"));
    const auto recording = fild::read_kitti_layout(folder.path(), kTenHertz, calibration(0.2));
    EXPECT_DOUBLE_EQ(recording.frames[1].image.seconds, 0.1);
    EXPECT_EQ(recording.calibration->baseline_m, 0.2);
}

TEST(KittiLayout, SaysWhatIsMissing)
{
    const TemporaryFolder folder;
    const auto error = [&] { return error_of([&] { read_kitti(folder); }); };
    EXPECT_THAT(error(), AllOf(HasSubstr("neither image_0 nor image_2"), HasSubstr("is empty")));
    EXPECT_THAT(error_of([&] { fild::read_kitti_layout(folder.path("none"), {}, {}); }),
                HasSubstr("no such folder: '" + folder.path("none")));
    fs::create_directory(folder.path("image_0"));
    EXPECT_THAT(error(), HasSubstr("no image in folder " + folder.path("image_0")));
    make_kitti(folder, "01");
    fs::remove(folder.path("times.txt"));
    EXPECT_THAT(error(), AllOf(HasSubstr("times.txt does not exist"), HasSubstr("--rate 10")));
    write_text(folder.path("times.txt"), "0\n");
    EXPECT_THAT(error(), HasSubstr("1 time in " + folder.path("times.txt") + " for 2 images"));
    make_kitti(folder, "");
    fs::remove(folder.path("calib.txt"));
    EXPECT_THAT(error(),
                AllOf(HasSubstr("--calib"),
                      HasSubstr("baseline"),
                      HasSubstr("put "),
                      HasSubstr("calib.txt there")));
    EXPECT_THAT(error_of([&] { read_kitti(folder, calibration()); }), HasSubstr("baseline METRES"));
}

TEST(KittiLayout, SaysWhatIsWrong)
{
    const TemporaryFolder folder;
    const auto error = [&] { return error_of([&] { read_kitti(folder); }); };
    make_kitti(folder, "01");
    fs::rename(folder.path("image_1/000001.png"), folder.path("image_1/000002.png"));
    EXPECT_THAT(error(), AllOf(HasSubstr("image_0/000001.png"), HasSubstr("image_1/000002.png")));
    fs::remove(folder.path("image_1/000002.png"));
    EXPECT_THAT(error(), AllOf(HasSubstr("2 images in"), HasSubstr("1 in")));
    const auto with_calibration = [&](const std::string& text)
    {
        make_kitti(folder, "01");
        write_text(folder.path("calib.txt"), text);
        return error();
    };
    EXPECT_THAT(with_calibration("P1: 1\n"), HasSubstr("no line 'P0: ...'"));
    EXPECT_THAT(with_calibration("P0: 1 2\n"), AllOf(HasSubstr("line 1"), HasSubstr("12 numbers")));
    EXPECT_THAT(with_calibration("P0: 7 x\n"), HasSubstr("'x' is not a number"));
    EXPECT_THAT(with_calibration("P0: 0 0 0 0 0 0 0 0 0 0 0 0\n"), HasSubstr("positive"));
    EXPECT_THAT(with_calibration("P0: 7 0 6 0 0 7 1 0 0 0 1 0\nP1: 7 0 6 0 0 7 1 0 0 0 1 0\n"),
                HasSubstr("the baseline after"));
    make_kitti(folder, "01");
    write_text(folder.path("image_0/000000.png"), "no image");
    EXPECT_THAT(error(), HasSubstr("image_0/000000.png is no image"));
}

// Malaga and New College

TEST(MalagaLayout, TakesTimesFromNames)
{
    const TemporaryFolder folder;
    make_files(folder,
               {"CAMERA_LEFT_1226322035.662892.jpg",
                "CAMERA_LEFT_1226322035.529528.jpg",
                "CAMERA_LEFT_999999999.5.png",
                "preview.jpg",
                "notes.txt"});
    const auto recording = fild::read_malaga_layout(folder.path(), std::nullopt);
    ASSERT_EQ(recording.frames.size(), 3U);
    EXPECT_EQ(recording.frames[0].image.seconds, 999999999.5) << "by time, not by name";
    EXPECT_EQ(recording.frames[2].image.seconds, 1226322035.662892);
    EXPECT_FALSE(recording.frames[2].right);
    EXPECT_FALSE(recording.calibration);
    EXPECT_THAT(recording.left_out, IsEmpty());
}

TEST(MalagaLayout, KeepsTheTwoCamerasApart)
{
    const TemporaryFolder folder;
    make_files(folder,
               {"CAMERA_LEFT_1.5.jpg",
                "CAMERA_LEFT_10.5.jpg",
                "CAMERA_RIGHT_1.504.jpg",
                "CAMERA_RIGHT_10.498.jpg",
                "CAMERA_RIGHT_11.5.jpg"});
    const auto recording = fild::read_malaga_layout(folder.path(), calibration(0.86));
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_FALSE(recording.frames[1].right);
    ASSERT_EQ(recording.right_camera.size(), 3U);
    EXPECT_EQ(name_of(recording.right_camera[1]), "CAMERA_RIGHT_10.498.jpg");
    EXPECT_EQ(recording.right_camera[1].seconds, 10.498);
    EXPECT_TRUE(recording.calibration);
}

TEST(MalagaLayout, SaysWhatIsWrong)
{
    const TemporaryFolder folder;
    const auto error = [&](const std::optional<Calibration>& with = calibration(0.86))
    { return error_of([&] { fild::read_malaga_layout(folder.path(), with); }); };
    EXPECT_THAT(error(), AllOf(HasSubstr("CAMERA_LEFT_1226322035.529528.jpg"), HasSubstr("empty")));
    make_files(folder, {"img_0001.jpg", "img_0002.jpg"});
    EXPECT_THAT(error(), HasSubstr("holds img_0001.jpg"));
    make_files(folder, {"CAMERA_LEFT_1.5.jpg", "CAMERA_RIGHT_1.6.jpg"});
    EXPECT_THAT(error(std::nullopt), AllOf(HasSubstr("--calib"), HasSubstr("right images out")));
    EXPECT_THAT(error(calibration()), HasSubstr("baseline METRES"));
    make_files(folder, {"CAMERA_LEFT_1.5.png"});
    EXPECT_THAT(error(), HasSubstr("are of the same time"));
    fs::remove(folder.path("CAMERA_LEFT_1.5.png"));
    make_files(folder, {"CAMERA_LEFT_1.5x.jpg"});
    EXPECT_THAT(error(), AllOf(HasSubstr("CAMERA_LEFT_1.5x.jpg"), HasSubstr("'1.5x' is no time")));
    fs::remove(folder.path("CAMERA_LEFT_1.5x.jpg"));
    make_files(folder, {"CAMERA_LEFT_1.50.jpg", "CAMERA_RIGHT_1.5.jpg", "CAMERA_RIGHT_1.50.jpg"});
    EXPECT_THAT(error(), HasSubstr("does not grow"));
    EXPECT_THAT(error_of([&] { fild::read_malaga_layout(folder.path("none"), {}); }),
                HasSubstr("no such folder"));
}

TEST(NewCollegeLayout, PairsImagesOfTheSameTime)
{
    const TemporaryFolder folder;
    make_files(folder,
               {"StereoImage__1.5-left.pnm",
                "StereoImage__2.5-left.pnm",
                "StereoImage__10.5-left.pnm",
                "StereoImage__1.5-right.pnm",
                "StereoImage__10.5-right.pnm",
                "StereoImage__11.5-right.pnm",
                "StereoImage__12.5-right.pnm"});
    const auto recording = fild::read_newcollege_layout(folder.path(), calibration(0.86));
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_EQ(name_of(recording.frames[1].image), "StereoImage__10.5-left.pnm");
    EXPECT_EQ(name_of(*recording.frames[1].right), "StereoImage__10.5-right.pnm");
    EXPECT_THAT(
        recording.left_out,
        ElementsAre("1 left image without a right one", "2 right images without a left one"));
}

TEST(NewCollegeLayout, SaysThatNoImageHasAPartner)
{
    const TemporaryFolder folder;
    make_files(folder, {"StereoImage__1.5-left.pnm", "StereoImage__1.6-right.pnm"});
    EXPECT_THAT(
        error_of([&] { fild::read_newcollege_layout(folder.path(), calibration(0.12)); }),
        AllOf(HasSubstr("StereoImage__1.5-left.pnm"), HasSubstr("StereoImage__1.6-right.pnm")));
}

TEST(NewCollegeLayout, ReadsItsNames)
{
    const TemporaryFolder folder;
    make_files(folder,
               {"StereoImage__1225719815.864878-left.pnm",
                "StereoImage__1225719816.864764-left.pnm",
                "StereoImage__1225719816.864764.pnm"});
    EXPECT_FALSE(fild::read_newcollege_layout(folder.path(), {}).frames[1].right);
    make_files(folder, {"StereoImage__1225719816.864764-right.pnm"});
    const auto recording = fild::read_newcollege_layout(folder.path(), calibration(0.12));
    ASSERT_EQ(recording.frames.size(), 1U);
    EXPECT_EQ(recording.frames[0].image.seconds, 1225719816.864764);
    EXPECT_EQ(name_of(*recording.frames[0].right), "StereoImage__1225719816.864764-right.pnm");
    const TemporaryFolder empty;
    EXPECT_THAT(error_of([&] { fild::read_newcollege_layout(empty.path(), {}); }),
                HasSubstr("StereoImage__1225719815.864878-left.pnm"));
}

// TUM

/** What TUM's text files say; the images themselves are not there. */
void write_tum(const TemporaryFolder& folder, const std::string& rgb, const std::string& depth)
{
    write_text(folder.path("rgb.txt"), "# color images\n# timestamp filename\n" + rgb);
    write_text(folder.path("depth.txt"), "# depth maps\n" + depth);
}

Recording read_tum(const TemporaryFolder& folder)
{
    return fild::read_tum_layout(folder.path(), calibration());
}

TEST(TumLayout, PairsTheNearestInTime)
{
    const TemporaryFolder folder;
    write_tum(folder,
              "1305031102.175304 rgb/1305031102.175304.png\n"
              "1305031102.211214 rgb/1305031102.211214.png\n",
              "1305031102.160407 depth/1305031102.160407.png\n"
              "1305031102.194330 depth/1305031102.194330.png\n"
              "1305031102.226738 depth/1305031102.226738.png\n");
    const auto recording = read_tum(folder);
    ASSERT_EQ(recording.frames.size(), 2U);
    const auto& frame = recording.frames[0];
    EXPECT_EQ(frame.image.path, folder.path("rgb/1305031102.175304.png"));
    EXPECT_EQ(frame.image.seconds, 1305031102.175304);
    EXPECT_EQ(frame.depth->path, folder.path("depth/1305031102.160407.png"));
    EXPECT_THAT(frame.depth->origin, HasSubstr("depth.txt line 2"));
    EXPECT_EQ(name_of(*recording.frames[1].depth), "1305031102.226738.png");
    EXPECT_EQ(recording.depth_units_per_metre, 5000);
    EXPECT_THAT(recording.left_out,
                ElementsAre("1 depth image without a colour image within 0.02 s"));
    EXPECT_THAT(recording.robot_path, IsEmpty());
}

/** The nearest pair of all is made first, even if that leaves another image alone. */
TEST(TumLayout, UsesEachImageOnceAndKeepsToTheLimit)
{
    const TemporaryFolder folder;
    write_tum(folder,
              "1.000 a.png\n1.010 b.png\n2.000 c.png\n3.000 d.png\n",
              "1.012 x.png\n2.0201 y.png\n3.0199 my z.png\n");
    const auto recording = read_tum(folder);
    ASSERT_EQ(recording.frames.size(), 2U);
    EXPECT_EQ(name_of(recording.frames[0].image), "b.png");
    EXPECT_EQ(name_of(*recording.frames[0].depth), "x.png");
    EXPECT_EQ(name_of(recording.frames[1].image), "d.png");
    EXPECT_EQ(name_of(*recording.frames[1].depth), "my z.png");
    EXPECT_THAT(recording.left_out,
                ElementsAre("2 colour images without a depth image within 0.02 s",
                            "1 depth image without a colour image within 0.02 s"));
}

TEST(TumLayout, TurnsTheGroundTruthToTheRobot)
{
    const TemporaryFolder folder;
    write_tum(folder, "1 a.png\n", "1 x.png\n");
    write_text(folder.path("groundtruth.txt"),
               "# timestamp tx ty tz qx qy qz qw\n"
               "0.5 1 2 3 -0.5 0.5 -0.5 0.5\n"
               "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n");
    const auto path = read_tum(folder).robot_path;
    ASSERT_EQ(path.size(), 2U);
    // The first camera looks along x with its top to z: so the robot is not turned at all.
    EXPECT_EQ(path[0].seconds, 0.5);
    EXPECT_EQ(path[0].z, 3);
    EXPECT_NEAR(std::abs(path[0].qw), 1, 1e-9);
    // The second: the camera of a robot that stands there is where it was.
    EXPECT_EQ(path[1].seconds, 1305031098.6659);
    const auto pose = [](double x, double y, double z, double qx, double qy, double qz, double qw)
    {
        mrpt::math::CQuaternionDouble turn(qw, qx, qy, qz);
        turn.normalize();
        return mrpt::poses::CPose3D(turn, x, y, z);
    };
    const auto& p = path[1];
    const auto world_from_robot = pose(p.x, p.y, p.z, p.qx, p.qy, p.qz, p.qw);
    const auto world_from_camera = pose(1.3563, 0.6305, 1.6380, 0.6132, 0.5962, -0.3311, -0.3986);
    const auto ahead_for_robot = world_from_robot.composePoint({2, -3, -4});
    const auto ahead_for_camera = world_from_camera.composePoint({3, 4, 2});
    EXPECT_LT((ahead_for_robot - ahead_for_camera).norm(), 1e-9);
}

TEST(TumLayout, SaysWhatIsWrong)
{
    const TemporaryFolder folder;
    const auto error = [&] { return error_of([&] { read_tum(folder); }); };
    EXPECT_THAT(error(), AllOf(HasSubstr("no rgb.txt in"), HasSubstr("is empty")));
    write_text(folder.path("rgb.txt"), "1 a.png\n");
    EXPECT_THAT(error(), AllOf(HasSubstr("no depth.txt in"), HasSubstr("holds rgb.txt")));
    write_tum(folder, "1 a.png\n", "");
    EXPECT_THAT(error(), HasSubstr("no image in " + folder.path("depth.txt")));
    for (const std::string line : {"a.png", "a.png 1", "1", "1.0.0 a.png"})
    {
        write_tum(folder, "1 a.png\n", line + "\n");
        EXPECT_THAT(error(), AllOf(HasSubstr("depth.txt line 2"), HasSubstr("'SECONDS IMAGE'")));
    }
    write_tum(folder, "1 a.png\n1 b.png\n", "1 x.png\n");
    EXPECT_THAT(error(), HasSubstr("does not grow"));
    write_tum(folder, "1 a.png\n", "2 x.png\n");
    EXPECT_THAT(error(), HasSubstr("within 0.02 s"));
    write_tum(folder, "1 a.png\n", "1 x.png\n");
    write_text(folder.path("groundtruth.txt"), "1 0 0 0 0 0 1\n");
    EXPECT_THAT(error(), AllOf(HasSubstr("groundtruth.txt line 1"), HasSubstr("got 7 numbers")));
    write_text(folder.path("groundtruth.txt"), "1 0 0 0 0 0 0 0.9\n");
    EXPECT_THAT(error(), HasSubstr("norm"));
    EXPECT_THAT(error_of([&] { fild::read_tum_layout(folder.path("none"), calibration()); }),
                HasSubstr("no such folder"));
}

// Options

LayoutRequest request_for(ImageLayout layout)
{
    LayoutRequest request;
    request.layout = layout;
    request.images_dir = "/nowhere";
    return request;
}

std::string refusal(const LayoutRequest& request)
{
    return message_of<std::invalid_argument>([&] { fild::read_recording(request); });
}

TEST(ReadRecording, RefusesOptionsThatDoNotGoWithTheLayout)
{
    auto request = request_for(ImageLayout::kitti);
    request.depth_dir = "d";
    EXPECT_EQ(refusal(request), "--depth does not go with --format kitti, only with list");
    request = request_for(ImageLayout::malaga);
    request.timestamps.rate_hz = 1;
    EXPECT_EQ(refusal(request),
              "--rate does not go with --format malaga, only with list, stereo, kitti");
    request = request_for(ImageLayout::tum);
    request.timestamps.file = "t";
    EXPECT_THAT(refusal(request), HasSubstr("--timestamps does not go with --format tum"));
    request = request_for(ImageLayout::list);
    request.right_dir = "r";
    EXPECT_THAT(refusal(request),
                HasSubstr("--right does not go with --format list, only with stereo"));
    request = request_for(ImageLayout::newcollege);
    request.list_path = "l";
    EXPECT_THAT(refusal(request), HasSubstr("--list does not go with --format newcollege"));
    request = request_for(ImageLayout::stereo);
    request.depth_units_per_metre = 1;
    EXPECT_THAT(refusal(request), HasSubstr("--depth-scale does not go with --format stereo"));
}

TEST(ReadRecording, NamesTheOptionThatIsMissing)
{
    EXPECT_THAT(refusal(request_for(ImageLayout::tum)), HasSubstr("depth needs --calib"));
    auto request = request_for(ImageLayout::stereo);
    EXPECT_THAT(refusal(request), HasSubstr("needs --right"));
    request.right_dir = "r";
    EXPECT_THAT(refusal(request), AllOf(HasSubstr("needs --calib"), HasSubstr("baseline")));
    request = request_for(ImageLayout::list);
    request.depth_units_per_metre = 1;
    EXPECT_THAT(refusal(request), HasSubstr("without --depth"));
    request.depth_dir = "d";
    EXPECT_THAT(refusal(request), HasSubstr("depth needs --calib"));
    request.calibration_path = "c";
    for (const double units : {0.0, -5000.0, std::nan("")})
    {
        request.depth_units_per_metre = units;
        EXPECT_THAT(refusal(request), HasSubstr("--depth-scale must be above 0"));
    }
}

TEST(ReadRecording, ReadsEachLayoutAsAsked)
{
    const TemporaryFolder folder;
    make_files(folder, {"1.png", "r/1.png", "d/1.png", "CAMERA_LEFT_1.jpg", "t/x"});
    make_files(folder, {"s/1.png", "n/StereoImage__1-left.pnm"});
    make_kitti(folder, "0");
    write_text(folder.path("t/rgb.txt"), "1 a.png\n");
    write_text(folder.path("t/depth.txt"), "1 x.png\n");
    write_text(folder.path("calib"), "50 51 32 24 64 48\nbaseline 0.2\n");
    const auto read = [&](ImageLayout layout,
                          const std::string& dir,
                          const std::function<void(LayoutRequest&)>& change)
    {
        auto request = request_for(layout);
        request.images_dir = folder.path(dir);
        request.calibration_path = folder.path("calib");
        change(request);
        auto recording = fild::read_recording(request);
        EXPECT_EQ(recording.calibration->camera.fx, 50);
        return recording;
    };
    const auto as_it_is = [](LayoutRequest&) {};
    const auto at_ten_hertz = [](LayoutRequest& r) { r.timestamps = kTenHertz; };
    EXPECT_EQ(read(ImageLayout::list, "s", at_ten_hertz).frames.size(), 1U);
    EXPECT_EQ(read(ImageLayout::kitti, "", at_ten_hertz).frames.size(), 2U);
    EXPECT_EQ(read(ImageLayout::malaga, "", as_it_is).frames.size(), 1U);
    EXPECT_EQ(read(ImageLayout::newcollege, "n", as_it_is).frames.size(), 1U);
    EXPECT_EQ(read(ImageLayout::tum, "t", as_it_is).depth_units_per_metre, 5000);
    const auto stereo = read(ImageLayout::stereo,
                             "s",
                             [&](LayoutRequest& r)
                             {
                                 r.timestamps = kTenHertz;
                                 r.right_dir = folder.path("r");
                             });
    EXPECT_TRUE(stereo.frames[0].right);
    const auto depth = read(ImageLayout::list,
                            "s",
                            [&](LayoutRequest& r)
                            {
                                r.timestamps = kTenHertz;
                                r.depth_dir = folder.path("d");
                                r.depth_units_per_metre = 256;
                            });
    EXPECT_TRUE(depth.frames[0].depth);
    EXPECT_EQ(depth.depth_units_per_metre, 256);
}

}  // namespace
