// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_rawlog.h"

#include "drawn_rawlog.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "message_of.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <set>

namespace
{
using namespace fild::testing;
using fild::ImageFile;
using fild::ImageRawlogRequest;
using fild::Recording;
using fild::StampedImage;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/** Images a.png and b.png in `in`, and another a.png in `in/sub`. */
void draw_images(const TemporaryFolder& folder)
{
    fs::create_directories(folder.path("in/sub"));
    fs::create_directory(folder.path("out"));
    cv::imwrite(folder.path("in/a.png"), draw_image(CV_8UC3, 1));
    cv::imwrite(folder.path("in/b.png"), draw_image(CV_8UC3, 2));
    cv::imwrite(folder.path("in/sub/a.png"), draw_image(CV_8UC3, 3));
}

StampedImage listed(const std::string& path, double seconds)
{
    return {{path, "list.txt line 7"}, seconds};
}

/** Frames that show draw_image() with the seeds 2, 1, 3, 2. */
Recording four_frames(const TemporaryFolder& folder)
{
    return fild::mono_recording({listed(folder.path("in/b.png"), 0),
                                 listed(folder.path("in/a.png"), 0.1),
                                 listed(folder.path("in/sub/a.png"), 0.2),
                                 listed(folder.path("in/sub/../b.png"), 0.3)});
}

fild::Calibration calibration(const std::string& words,
                              std::optional<double> baseline_m = std::nullopt)
{
    return {fild::parse_camera_model(words, "test"), baseline_m};
}

ImageRawlogRequest request_in(const TemporaryFolder& folder)
{
    ImageRawlogRequest request;
    request.rawlog_path = folder.path("out/run.rawlog");
    return request;
}

std::size_t entries_in(const std::string& path)
{
    const fs::directory_iterator entries(path);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

void expect_four_frames(const std::string& rawlog)
{
    fild::RawlogReader reader(rawlog);
    fild::FrameBuilder builder(fild::TInputOptions(), rawlog);
    const std::vector<int> seeds{2, 1, 3, 2};
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
        const auto observation = reader.next();
        ASSERT_NE(observation, nullptr);
        ASSERT_TRUE(builder.accepts(*observation));
        const auto frame = builder.build(*observation);
        EXPECT_NEAR(frame.timestamp, 0.1 * static_cast<double>(i), 1e-7);
        EXPECT_EQ(frame.sensor_label, "CAMERA1");
        ASSERT_EQ(frame.defect, fild::Rejection::none);
        EXPECT_EQ(cv::norm(frame.image, draw_image(CV_8UC3, seeds[i]), cv::NORM_INF), 0) << i;
    }
    EXPECT_EQ(reader.next(), nullptr);
}

/** Runs into an error; checks that the output folder is then as it was. */
std::string error_of(const TemporaryFolder& folder,
                     const Recording& recording,
                     const ImageRawlogRequest& request)
{
    const auto before = entries_in(folder.path("out"));
    auto message =
        message_of<std::runtime_error>([&] { fild::write_image_rawlog(recording, request); });
    EXPECT_EQ(entries_in(folder.path("out")), before);
    return message;
}

TEST(ImageRawlog, PutsEachDistinctImageOnceBesideTheRawlog)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto summary = fild::write_image_rawlog(four_frames(folder), request_in(folder));
    EXPECT_EQ(summary.frames, 4U);
    EXPECT_EQ(summary.images, 3U);
    EXPECT_EQ(summary.images_dir, folder.path("out/run_Images"));
    EXPECT_EQ(entries_in(folder.path("out")), 2U);
    EXPECT_TRUE(fs::exists(folder.path("out/run_Images/a_2.png"))) << "second of its name";
    EXPECT_EQ(entries_in(folder.path("out/run_Images")), 3U);
    EXPECT_EQ(fs::hard_link_count(folder.path("in/b.png")), 2U) << "linked, not copied";
    expect_four_frames(folder.path("out/run.rawlog"));
}

TEST(ImageRawlog, EmbedsImagesWithoutLoss)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    request.embed = true;
    const auto summary = fild::write_image_rawlog(four_frames(folder), request);
    EXPECT_EQ(summary.images, 3U);
    EXPECT_EQ(entries_in(folder.path("out")), 1U);
    fs::remove_all(folder.path("in"));
    expect_four_frames(folder.path("out/run.rawlog"));
}

TEST(ImageRawlog, FollowsSymbolicLinks)
{
    const TemporaryFolder folder;
    draw_images(folder);
    fs::create_symlink("a.png", folder.path("in/link.png"));
    const auto summary =
        fild::write_image_rawlog(fild::mono_recording({listed(folder.path("in/link.png"), 0),
                                                       listed(folder.path("in/a.png"), 1)}),
                                 request_in(folder));
    EXPECT_EQ(summary.images, 1U);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path("out/run_Images/link.png"))));
}

TEST(ImageRawlog, CarriesCalibrationAndLabel)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    request.sensor_label = "FRONT";
    auto recording = four_frames(folder);
    recording.calibration = calibration("50 51 32 24 64 48 -0.1 0 0 0");
    fild::write_image_rawlog(recording, request);
    fild::FrameBuilder builder(fild::TInputOptions(), request.rawlog_path);
    const auto frame = builder.build(*fild::RawlogReader(request.rawlog_path).next());
    EXPECT_EQ(frame.sensor_label, "FRONT");
    ASSERT_TRUE(frame.camera);
    EXPECT_DOUBLE_EQ(frame.camera->fy, 51);
}

const std::string kCamera = "50 51 32 24 64 48";

ImageFile file(const std::string& path)
{
    return {path, path};
}

/** Two frames with a right image of the name of the left one. */
Recording stereo_recording(const TemporaryFolder& folder)
{
    Recording recording;
    recording.calibration = calibration(kCamera, 0.12);
    fs::create_directories(folder.path("in/right"));
    for (const std::string name : {"a.png", "b.png"})
    {
        cv::imwrite(folder.path("in/right/" + name), draw_image(CV_8UC3, 20 + name[0]));
        recording.frames.push_back({listed(folder.path("in/" + name), name[0]),
                                    file(folder.path("in/right/" + name)),
                                    std::nullopt});
    }
    return recording;
}

/** Depth that holds the extremes of its type. */
cv::Mat draw_depth(cv::Size size = {64, 48})
{
    cv::Mat depth(size, CV_16UC1, cv::Scalar(0));
    for (int row = 0; row < depth.rows; ++row)
        for (int col = 0; col < depth.cols; ++col)
            depth.at<std::uint16_t>(row, col) = static_cast<std::uint16_t>(row * 1000 + col);
    depth.at<std::uint16_t>(0, 63) = 65535;
    return depth;
}

Recording depth_recording(const TemporaryFolder& folder, const cv::Mat& depth = draw_depth())
{
    Recording recording;
    recording.calibration = calibration(kCamera);
    recording.depth_units_per_metre = 5000;
    cv::imwrite(folder.path("in/depth.png"), depth);
    recording.frames.push_back(
        {listed(folder.path("in/a.png"), 7), std::nullopt, file(folder.path("in/depth.png"))});
    return recording;
}

template <class Observation>
std::shared_ptr<Observation> first_observation(const std::string& rawlog)
{
    return std::dynamic_pointer_cast<Observation>(fild::RawlogReader(rawlog).next());
}

/** What the camera sees straight ahead, one metre away, is at (1, 0, 0) on the robot; what it sees
 *  to the right is there at negative y, what it sees below at negative z. */
void expect_looks_forward(const mrpt::obs::CObservation& observation)
{
    const auto on_robot = [&](double x, double y, double z) {
        return observation.sensorPose().composePoint({x, y, z});
    };
    EXPECT_LT((on_robot(0, 0, 1) - mrpt::math::TPoint3D(1, 0, 0)).norm(), 1e-9);
    EXPECT_LT((on_robot(1, 0, 0) - mrpt::math::TPoint3D(0, -1, 0)).norm(), 1e-9);
    EXPECT_LT((on_robot(0, 1, 0) - mrpt::math::TPoint3D(0, 0, -1)).norm(), 1e-9);
}

TEST(ImageRawlog, PutsTheCameraOnTheRobotLookingForward)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto request = request_in(folder);
    fild::write_image_rawlog(four_frames(folder), request);
    expect_looks_forward(*first_observation<mrpt::obs::CObservationImage>(request.rawlog_path));
}

TEST(ImageRawlog, WritesStereoPairs)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto request = request_in(folder);
    const auto summary = fild::write_image_rawlog(stereo_recording(folder), request);
    EXPECT_EQ(summary.frames, 2U);
    EXPECT_EQ(summary.images, 4U);
    EXPECT_EQ(summary.depth_images, 0U);
    const auto pair = first_observation<mrpt::obs::CObservationStereoImages>(request.rawlog_path);
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(pair->imageLeft.getExternalStorageFile(), "a_left.png");
    EXPECT_EQ(pair->imageRight.getExternalStorageFile(), "a_right.png");
    EXPECT_TRUE(pair->hasImageRight);
    EXPECT_FALSE(pair->hasImageDisparity);
    EXPECT_TRUE(pair->areImagesRectified());
    EXPECT_DOUBLE_EQ(pair->leftCamera.fy(), 51);
    EXPECT_DOUBLE_EQ(pair->rightCamera.fy(), 51);
    EXPECT_EQ(mrpt::poses::CPose3D(pair->rightCameraPose),
              mrpt::poses::CPose3D(0.12, 0, 0, 0, 0, 0));
    EXPECT_EQ(pair->getStereoCameraParams().rightCameraPose.x, 0.12);
    expect_looks_forward(*pair);
    const auto right = cv::imread(folder.path("out/run_Images/a_right.png"));
    EXPECT_EQ(cv::norm(right, draw_image(CV_8UC3, 20 + 'a'), cv::NORM_INF), 0);
    fild::FrameBuilder builder(fild::TInputOptions(), request.rawlog_path);
    ASSERT_TRUE(builder.accepts(*pair));
    const auto frame = builder.build(*pair);
    EXPECT_EQ(cv::norm(frame.image, draw_image(CV_8UC3, 1), cv::NORM_INF), 0);
    EXPECT_TRUE(frame.camera);
}

/** The right camera has another focal length, and is turned to the left by 10 degrees. */
fild::Calibration unequal_calibration()
{
    auto both = calibration(kCamera);
    both.right = both.camera;
    both.right->fx = 60;
    both.right_pose =
        fild::RigidTransform{fild::rotation_from_vector({0, -0.1745, 0}), {0.3, 0, 0}};
    return both;
}

TEST(ImageRawlog, WritesPairsOfUnequalCameras)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto request = request_in(folder);
    auto recording = stereo_recording(folder);
    recording.calibration = unequal_calibration();
    fild::write_image_rawlog(recording, request);
    const auto pair = first_observation<mrpt::obs::CObservationStereoImages>(request.rawlog_path);
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(pair->rightCamera.fx(), 60);
    EXPECT_NEAR(pair->rightCameraPose.x(), 0.3, 1e-9);
    EXPECT_NEAR(mrpt::poses::CPose3D(pair->rightCameraPose).pitch(), -0.1745, 1e-9);
}

TEST(ImageRawlog, WritesTwoCamerasThatRecordedByThemselves)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    auto recording = four_frames(folder);
    recording.calibration = unequal_calibration();
    for (const auto& [name, seconds] : {std::pair("a.png", 0.004), {"a.png", 0.199}})
        recording.right_camera.push_back(listed(folder.path("in/" + std::string(name)), seconds));
    EXPECT_EQ(fild::write_image_rawlog(recording, request).frames, 4U);
    fild::RawlogReader reader(request.rawlog_path);
    std::string labels;
    while (const auto observation = reader.next())
    {
        labels += observation->sensorLabel + " ";
        const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(observation);
        ASSERT_NE(image, nullptr);
        const bool is_left = image->sensorLabel == "CAMERA_LEFT";
        EXPECT_EQ(image->cameraParams.fx(), is_left ? recording.calibration->camera.fx : 60);
        if (is_left) continue;
        // To the right on the robot is negative y; turned to the left is positive yaw.
        EXPECT_NEAR(image->cameraPose.y(), -0.3, 1e-9);
        const auto ahead = image->cameraPose.composePoint({0, 0, 1});
        EXPECT_NEAR(ahead.y, -0.3 + std::sin(0.1745), 1e-9);
    }
    EXPECT_EQ(labels, "CAMERA_LEFT CAMERA_RIGHT CAMERA_LEFT CAMERA_RIGHT CAMERA_LEFT CAMERA_LEFT ");
    request.rawlog_path = folder.path("out/other.rawlog");
    request.sensor_label = "EYE";
    EXPECT_THROW(fild::write_image_rawlog(recording, request), std::invalid_argument);
    request.sensor_label.reset();
    recording.calibration->right_pose.reset();
    EXPECT_THROW(fild::write_image_rawlog(recording, request), std::invalid_argument);
}

TEST(ImageRawlog, KeepsNamesOfPairsThatDiffer)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto recording = stereo_recording(folder);
    recording.frames.resize(1);
    recording.frames[0].right = file(folder.path("in/b.png"));
    fild::write_image_rawlog(recording, request_in(folder));
    EXPECT_TRUE(fs::exists(folder.path("out/run_Images/a.png")));
    EXPECT_TRUE(fs::exists(folder.path("out/run_Images/b.png")));
}

TEST(ImageRawlog, EmbedsStereoPairs)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    request.embed = true;
    fild::write_image_rawlog(stereo_recording(folder), request);
    const auto pair = first_observation<mrpt::obs::CObservationStereoImages>(request.rawlog_path);
    ASSERT_NE(pair, nullptr);
    const auto& right = pair->imageRight.asCvMatRef();
    EXPECT_EQ(cv::norm(right, draw_image(CV_8UC3, 20 + 'a'), cv::NORM_INF), 0);
}

TEST(ImageRawlog, WritesDepthWithoutLoss)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto request = request_in(folder);
    const auto summary = fild::write_image_rawlog(depth_recording(folder), request);
    EXPECT_EQ(summary.images, 1U);
    EXPECT_EQ(summary.depth_images, 1U);
    const auto scan = first_observation<mrpt::obs::CObservation3DRangeScan>(request.rawlog_path);
    ASSERT_NE(scan, nullptr);
    ASSERT_TRUE(scan->hasRangeImage && scan->hasIntensityImage && scan->range_is_depth);
    const cv::Mat stored(48, 64, CV_16UC1, scan->rangeImage.data());
    EXPECT_EQ(cv::norm(stored, draw_depth(), cv::NORM_INF), 0);
    EXPECT_EQ(scan->rangeUnits, 0.0002F);
    EXPECT_NEAR(scan->maxRange, 13.107, 1e-4);
    EXPECT_TRUE(scan->doDepthAndIntensityCamerasCoincide());
    EXPECT_EQ(scan->sensorPose, mrpt::poses::CPose3D());
    EXPECT_DOUBLE_EQ(scan->cameraParams.fy(), 51);
    EXPECT_DOUBLE_EQ(scan->cameraParamsIntensity.fy(), 51);
    EXPECT_EQ(scan->intensityImage.getExternalStorageFile(), "a.png");
    fild::FrameBuilder builder(fild::TInputOptions(), request.rawlog_path);
    ASSERT_TRUE(builder.accepts(*scan));
    EXPECT_EQ(builder.build(*scan).defect, fild::Rejection::none);
}

/** MRPT itself finds the point that was seen where it is. */
TEST(ImageRawlog, PutsDepthIntoTheFrameOfTheRobot)
{
    const TemporaryFolder folder;
    draw_images(folder);
    cv::Mat depth(48, 64, CV_16UC1, cv::Scalar(0));
    depth.at<std::uint16_t>(44, 52) = 10000;  // 2 m ahead, 20 px to the right, 20 px down
    const auto request = request_in(folder);
    fild::write_image_rawlog(depth_recording(folder, depth), request);
    const auto scan = first_observation<mrpt::obs::CObservation3DRangeScan>(request.rawlog_path);
    ASSERT_NE(scan, nullptr);
    mrpt::obs::T3DPointsProjectionParams on_robot;
    on_robot.takeIntoAccountSensorPoseOnRobot = true;
    scan->unprojectInto(*scan, on_robot);
    ASSERT_EQ(scan->points3D_x.size(), 1U);
    EXPECT_NEAR(scan->points3D_x[0], 2, 1e-4);
    EXPECT_NEAR(scan->points3D_y[0], -2 * 20.0 / 50, 1e-4);
    EXPECT_NEAR(scan->points3D_z[0], -2 * 20.0 / 51, 1e-4);
}

TEST(ImageRawlog, WritesThePathOfTheRobot)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto recording = four_frames(folder);
    recording.robot_path = {{1305031098.6659, 0.1, -2, 1e-7, 0, 0, 0, 1}, {2, 0, 0, 0, 1, 0, 0, 0}};
    const auto request = request_in(folder);
    const auto summary = fild::write_image_rawlog(recording, request);
    EXPECT_EQ(summary.ground_truth_path, folder.path("out/run.gt.tum"));
    EXPECT_EQ(read_text(summary.ground_truth_path),
              "1305031098.6659 0.1 -2 0.0000001 0 0 0 1\n2 0 0 0 1 0 0 0\n");
    fs::remove(request.rawlog_path);
    fs::remove_all(folder.path("out/run_Images"));
    EXPECT_THAT(error_of(folder, recording, request), HasSubstr("run.gt.tum exists already"));
}

TEST(ImageRawlog, RefusesPartnersThatDoNotFit)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto request = request_in(folder);
    auto stereo = stereo_recording(folder);
    cv::imwrite(stereo.frames[1].right->path, draw_image(CV_8UC3, 1, {60, 40}));
    EXPECT_THAT(error_of(folder, stereo, request),
                AllOf(HasSubstr("right/b.png"), HasSubstr("60x40"), HasSubstr("64x48")));
    fs::remove(stereo.frames[1].right->path);
    EXPECT_THAT(error_of(folder, stereo, request), HasSubstr("right/b.png does not exist"));
    EXPECT_THAT(error_of(folder, depth_recording(folder, draw_depth({60, 40})), request),
                AllOf(HasSubstr("depth.png"), HasSubstr("60x40"), HasSubstr("64x48")));
    EXPECT_THAT(error_of(folder, depth_recording(folder, draw_image(CV_8UC1)), request),
                AllOf(HasSubstr("depth.png"), HasSubstr("16-bit")));
}

TEST(ImageRawlog, RefusesARecordingThatContradictsItself)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto error = [&](const Recording& recording)
    {
        return message_of<std::invalid_argument>(
            [&] { fild::write_image_rawlog(recording, request_in(folder)); });
    };
    auto recording = stereo_recording(folder);
    recording.calibration->baseline_m.reset();
    EXPECT_THAT(error(recording), HasSubstr("baseline"));
    recording = stereo_recording(folder);
    recording.frames[1].right.reset();
    EXPECT_THAT(error(recording), HasSubstr("either"));
    recording = depth_recording(folder);
    recording.frames[0].right = file(folder.path("in/b.png"));
    EXPECT_THAT(error(recording), HasSubstr("either"));
    for (const double units : {0.0, -1.0, std::nan("")})
    {
        recording = depth_recording(folder);
        recording.depth_units_per_metre = units;
        EXPECT_THAT(error(recording), HasSubstr("above 0"));
    }
}

TEST(ImageRawlog, LeavesNothingWhenAnImageIsMissingOrBroken)
{
    const TemporaryFolder folder;
    draw_images(folder);
    for (const bool embed : {false, true})
    {
        auto request = request_in(folder);
        request.embed = embed;
        auto recording = four_frames(folder);
        recording.frames[2].image.path = folder.path("in/none.png");
        EXPECT_THAT(error_of(folder, recording, request),
                    AllOf(HasSubstr("none.png (list.txt line 7) does not exist")));
        fs::remove(folder.path("in/loop.png"));
        fs::create_symlink("loop.png", folder.path("in/loop.png"));
        recording.frames[2].image.path = folder.path("in/loop.png");
        EXPECT_THAT(error_of(folder, recording, request), HasSubstr("loop.png (list.txt line 7)"));
        recording.frames[2].image.path = folder.path("in/broken.png");
        write_text(recording.frames[2].image.path,
                   read_text(folder.path("in/a.png")).substr(0, 100));
        EXPECT_THAT(error_of(folder, recording, request),
                    AllOf(HasSubstr("broken.png (list.txt line 7)"), HasSubstr("repair")));
    }
}

TEST(ImageRawlog, RefusesPixelsAndSizesThatCannotBeUsed)
{
    const TemporaryFolder folder;
    draw_images(folder);
    cv::imwrite(folder.path("in/deep.tif"), draw_image(CV_32FC1));
    EXPECT_THAT(error_of(folder,
                         fild::mono_recording({listed(folder.path("in/deep.tif"), 0)}),
                         request_in(folder)),
                AllOf(HasSubstr("8 or 16 bit"), HasSubstr("32 bit floating point")));
    auto recording = four_frames(folder);
    recording.calibration = calibration("50 51 32 24 640 480");
    EXPECT_THAT(error_of(folder, recording, request_in(folder)),
                AllOf(HasSubstr("640x480"), HasSubstr("64x48")));
}

TEST(ImageRawlog, RefusesToReplaceWhatIsThere)
{
    const TemporaryFolder folder;
    draw_images(folder);
    fs::create_directory(folder.path("out/run_Images"));
    EXPECT_THAT(error_of(folder, four_frames(folder), request_in(folder)),
                HasSubstr("run_Images exists already; remove it"));
    write_text(folder.path("out/run.rawlog"), "precious");
    EXPECT_THAT(error_of(folder, four_frames(folder), request_in(folder)),
                HasSubstr("run.rawlog exists already; remove it"));
    EXPECT_EQ(read_text(folder.path("out/run.rawlog")), "precious");
}

TEST(ImageRawlog, RefusesABadRequest)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    EXPECT_THROW(fild::write_image_rawlog({}, request), std::invalid_argument);
    request.sensor_label = "";
    EXPECT_THROW(fild::write_image_rawlog(four_frames(folder), request), std::invalid_argument);
    request = request_in(folder);
    request.rawlog_path = folder.path("out/run.log");
    EXPECT_THROW(fild::write_image_rawlog(four_frames(folder), request), std::invalid_argument);
}

}  // namespace
