// SPDX-License-Identifier: BSD-3-Clause
// What FrameBuilder gives to metric poses.
#include "drawn_rawlog.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/frame_builder.h"
#include "message_of.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::DepthDefect;
using fild::Frame;
using fild::FrameBuilder;
using fild::FrameContent;
using fild::TInputOptions;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationStereoImages;
using mrpt::poses::CPose3D;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

fild::CameraModel camera()
{
    fild::CameraModel model;
    model.fx = model.fy = 50;
    model.cx = 31.5;
    model.cy = 23.5;
    model.width = kWidth;
    model.height = kHeight;
    return model;
}

/** From a mount with the robot's axes to its camera's. */
CPose3D mount_from_camera()
{
    return {0, 0, 0, -CV_PI / 2, 0, -CV_PI / 2};
}

Frame metric_frame(const mrpt::obs::CObservation& observation, const TInputOptions& options = {})
{
    FrameBuilder builder(options, "/nowhere/run.rawlog", FrameContent::metric);
    EXPECT_TRUE(builder.accepts(observation));
    return builder.build(observation);
}

mrpt::img::CImage to_image(const cv::Mat& pixels)
{
    return {pixels, mrpt::img::DEEP_COPY};
}

CObservationStereoImages::Ptr stereo_pair(double baseline = 0.2)
{
    auto stereo = CObservationStereoImages::Create();
    stereo->sensorLabel = "STEREO";
    stereo->timestamp = mrpt::Clock::fromDouble(1);
    stereo->imageLeft = to_image(draw_image(CV_8UC1, 1));
    stereo->imageRight = to_image(draw_image(CV_8UC1, 30));
    stereo->hasImageRight = true;
    stereo->leftCamera = stereo->rightCamera = mrpt_camera_from(camera());
    stereo->cameraPose = mrpt::poses::CPose3DQuat(CPose3D(1, 2, 3, 0, 0, 0) + mount_from_camera());
    stereo->rightCameraPose = mrpt::poses::CPose3DQuat(CPose3D(baseline, 0, 0, 0, 0, 0));
    return stereo;
}

std::uint16_t& at(CObservation3DRangeScan& scan, int row, int column)
{
    return scan.rangeImage(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
}

/** Its depth at a pixel in millimetres: 1000 + column + 100 * row; the corner has none. */
CObservation3DRangeScan::Ptr range_scan()
{
    auto scan = CObservation3DRangeScan::Create();
    scan->sensorLabel = "KINECT";
    scan->timestamp = mrpt::Clock::fromDouble(1);
    scan->hasIntensityImage = scan->hasRangeImage = true;
    scan->intensityImage = to_image(draw_image(CV_8UC3));
    scan->cameraParams = scan->cameraParamsIntensity = mrpt_camera_from(camera());
    scan->sensorPose = CPose3D(1, 2, 3, 0.5, 0, 0);
    scan->rangeUnits = 0.001F;
    scan->rangeImage_setSize(kHeight, kWidth);
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column)
            at(*scan, row, column) = static_cast<std::uint16_t>(1000 + column + 100 * row);
    at(*scan, 0, 0) = 0;
    return scan;
}

float depth_at(const Frame& frame, int row, int column)
{
    return frame.depth.at<float>(row, column);
}

TEST(MetricContent, IsLeftOutWhereNobodyAsks)
{
    FrameBuilder builder(TInputOptions(), "run.rawlog");
    for (const mrpt::obs::CObservation::Ptr& observation :
         {mrpt::obs::CObservation::Ptr(stereo_pair()), mrpt::obs::CObservation::Ptr(range_scan())})
    {
        const auto frame = builder.build(*observation);
        EXPECT_FALSE(frame.right);
        EXPECT_TRUE(frame.depth.empty());
        EXPECT_EQ(frame.depth_defect, DepthDefect::none);
    }
}

TEST(MetricContent, OfAStereoPairIsTheRightImageAndWhereItWasTaken)
{
    const auto frame = metric_frame(*stereo_pair());
    ASSERT_TRUE(frame.right);
    EXPECT_EQ(frame.depth_defect, DepthDefect::none);
    EXPECT_EQ(cv::norm(frame.right->image, draw_image(CV_8UC1, 30), cv::NORM_INF), 0);
    EXPECT_EQ(frame.right->left_from_right.translation, cv::Vec3d(0.2, 0, 0));
    EXPECT_EQ(frame.right->camera.fx, 50);
    ASSERT_TRUE(frame.robot_from_camera);
    const auto ahead = *frame.robot_from_camera * cv::Vec3d(0, 0, 10);
    EXPECT_LT(cv::norm(ahead - cv::Vec3d(11, 2, 3)), 1e-9) << "the optical axis is the robot's x";
}

TEST(MetricContent, StraightensTheRightImageByItsOwnLens)
{
    auto stereo = stereo_pair();
    auto bent = camera();
    bent.lens = fild::LensModel::plumb_bob;
    bent.distortion = {-0.3, 0.1};
    stereo->rightCamera = mrpt_camera_from(bent);
    auto frame = metric_frame(*stereo);
    ASSERT_TRUE(frame.right);
    EXPECT_EQ(frame.right->camera.lens, fild::LensModel::none);
    EXPECT_GT(cv::norm(frame.right->image, draw_image(CV_8UC1, 30), cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(frame.image, draw_image(CV_8UC1, 1), cv::NORM_INF), 0);

    TInputOptions options;
    options.undistort = false;
    frame = metric_frame(*stereo, options);
    EXPECT_FALSE(frame.right);
    EXPECT_EQ(frame.depth_defect, DepthDefect::distorted);
}

TEST(MetricContent, SaysWhyAPairGivesNoDepth)
{
    for (const double baseline : {0.0, -0.2, 1e-6, std::nan("")})
        EXPECT_EQ(metric_frame(*stereo_pair(baseline)).depth_defect, DepthDefect::unusable_baseline)
            << baseline;
    auto stereo = stereo_pair();
    stereo->hasImageRight = false;
    EXPECT_EQ(metric_frame(*stereo).depth_defect, DepthDefect::missing_right_image);
    stereo = stereo_pair();
    stereo->imageRight = to_image(draw_image(CV_32FC1));
    EXPECT_EQ(metric_frame(*stereo).depth_defect, DepthDefect::missing_right_image);
    stereo = stereo_pair();
    stereo->rightCamera = mrpt::img::TCamera();
    EXPECT_EQ(metric_frame(*stereo).depth_defect, DepthDefect::not_calibrated);
    stereo->leftCamera = mrpt::img::TCamera();
    const auto frame = metric_frame(*stereo);
    EXPECT_EQ(frame.depth_defect, DepthDefect::not_calibrated);
    EXPECT_FALSE(frame.image.empty()) << "none the worse for finding loops";
    EXPECT_EQ(metric_frame(*image_observation(draw_image(), 1)).depth_defect,
              DepthDefect::not_calibrated);
}

TEST(MetricContent, OfOneCameraIsItsPoseOnly)
{
    auto mono = image_observation(draw_image(), 1);
    mono->cameraParams = mrpt_camera_from(camera());
    const auto frame = metric_frame(*mono);
    EXPECT_EQ(frame.depth_defect, DepthDefect::mono);
    EXPECT_TRUE(frame.robot_from_camera);
}

TEST(MetricContent, NotesAMissingRightImageOrStops)
{
    auto stereo = stereo_pair();
    stereo->imageRight = mrpt::img::CImage();
    stereo->imageRight.setExternalStorage("none.png");
    FrameBuilder builder(TInputOptions(), "/nowhere/run.rawlog", FrameContent::metric);
    EXPECT_EQ(builder.build(*stereo).depth_defect, DepthDefect::missing_right_image);
    EXPECT_EQ(builder.first_missing_image(), "/nowhere/run_Images/none.png");
    TInputOptions options;
    options.on_missing_image = fild::OnMissingImage::stop;
    EXPECT_THAT(message_of<std::runtime_error>([&] { metric_frame(*stereo, options); }),
                ::testing::HasSubstr("none.png"));
}

TEST(MetricContent, NotesARightCalibrationForAnotherSize)
{
    using ::testing::AllOf;
    using ::testing::ElementsAre;
    using ::testing::HasSubstr;
    const auto notes_of = [](const mrpt::obs::CObservationStereoImages& stereo)
    {
        FrameBuilder builder(TInputOptions(), "/nowhere/run.rawlog", FrameContent::metric);
        const auto frame = builder.build(stereo);
        EXPECT_EQ(frame.depth_defect, DepthDefect::not_calibrated);
        EXPECT_TRUE(frame.camera) << "the left one is good";
        return builder.calibration_notes();
    };
    auto other_image = stereo_pair();
    other_image->imageRight = to_image(draw_image(CV_8UC1, 0, {32, 24}));
    EXPECT_THAT(notes_of(*other_image),
                ElementsAre(AllOf(HasSubstr("right camera of 'STEREO' is for 64x48 pixels"),
                                  HasSubstr("its images have 32x24"))));
    auto other_calibration = stereo_pair();
    other_calibration->rightCamera.ncols = 640;
    EXPECT_THAT(notes_of(*other_calibration),
                ElementsAre(AllOf(HasSubstr("is for 640x48 pixels"),
                                  HasSubstr("if only the size is wrong"))));
}

TEST(MetricContent, OfARangeScanIsTheDepthOfEachPixel)
{
    const auto frame = metric_frame(*range_scan());
    ASSERT_EQ(frame.depth.size(), frame.image.size());
    ASSERT_EQ(frame.depth.type(), CV_32FC1);
    EXPECT_TRUE(std::isnan(depth_at(frame, 0, 0)));
    EXPECT_FLOAT_EQ(depth_at(frame, 7, 5), 1.705F);
    const auto ahead = *frame.robot_from_camera * cv::Vec3d(0, 0, 10);
    EXPECT_LT(cv::norm(ahead - cv::Vec3d(1 + 10 * std::cos(0.5), 2 + 10 * std::sin(0.5), 3)), 1e-9);
}

TEST(MetricContent, TurnsDistancesIntoDepths)
{
    auto scan = range_scan();
    scan->range_is_depth = false;
    const auto frame = metric_frame(*scan);
    const double x = (5 - 31.5) / 50;
    const double y = (7 - 23.5) / 50;
    EXPECT_NEAR(
        static_cast<double>(depth_at(frame, 7, 5)), 1.705 / std::sqrt(1 + x * x + y * y), 1e-5);
    EXPECT_TRUE(std::isnan(depth_at(frame, 0, 0)));
}

TEST(MetricContent, RegistersTheDepthOfACameraBesideTheOther)
{
    auto scan = range_scan();
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column)
            at(*scan, row, column) = column < 32 ? 2000 : 4000;
    // The colour camera 0.2 m to the right: the edge at column 32 moves left by 5 pixels for the
    // near side; 2.5 pixels beyond it are hidden from the depth camera.
    scan->relativePoseIntensityWRTDepth = CPose3D(0, -0.2, 0, 0, 0, 0) + mount_from_camera();
    const auto frame = metric_frame(*scan);
    EXPECT_FLOAT_EQ(depth_at(frame, 20, 10), 2);
    EXPECT_FLOAT_EQ(depth_at(frame, 20, 26), 2);
    EXPECT_FLOAT_EQ(depth_at(frame, 20, 31), 4);
    EXPECT_TRUE(std::isnan(depth_at(frame, 20, 62))) << "beside the depth camera's view";
}

TEST(MetricContent, RegistersASmallerDepthImageWithoutHoles)
{
    auto scan = range_scan();
    auto half = camera();
    half.width = kWidth / 2;
    half.height = kHeight / 2;
    half.fx = half.fy = 25;
    half.cx = 15.5;
    half.cy = 11.5;
    scan->cameraParams = mrpt_camera_from(half);
    scan->rangeImage_setSize(kHeight / 2, kWidth / 2);
    scan->rangeImage.fill(3000);
    const auto frame = metric_frame(*scan);
    EXPECT_EQ(cv::countNonZero((frame.depth > 2.999) & (frame.depth < 3.001)), kWidth * kHeight);
}

TEST(MetricContent, SaysWhyAScanGivesNoDepth)
{
    auto scan = range_scan();
    scan->hasRangeImage = false;
    EXPECT_EQ(metric_frame(*scan).depth_defect, DepthDefect::missing_depth_image);
    scan = range_scan();
    scan->cameraParamsIntensity = mrpt::img::TCamera();
    EXPECT_EQ(metric_frame(*scan).depth_defect, DepthDefect::not_calibrated);
    scan = range_scan();
    scan->cameraParams = mrpt::img::TCamera();
    EXPECT_EQ(metric_frame(*scan).depth_defect, DepthDefect::not_calibrated);
    scan = range_scan();
    scan->rangeImage.fill(0);
    EXPECT_EQ(metric_frame(*scan).depth_defect, DepthDefect::empty_depth_image);
    EXPECT_TRUE(metric_frame(*scan).depth.empty());
}

TEST(MetricContent, ReadsRangesStoredOutsideTheRawlog)
{
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path("run_Images"));
    for (const bool text : {false, true})
    {
        auto scan = range_scan();
        CObservation3DRangeScan::EXTERNALS_AS_TEXT(text);
        scan->rangeImage_convertToExternalStorage(text ? "d.txt" : "d.bin",
                                                  folder.path("run_Images/"));
        CObservation3DRangeScan::EXTERNALS_AS_TEXT(false);
        FrameBuilder builder(TInputOptions(), folder.path("run.rawlog"), FrameContent::metric);
        const auto frame = builder.build(*scan);
        ASSERT_FALSE(frame.depth.empty()) << to_word(frame.depth_defect);
        EXPECT_FLOAT_EQ(depth_at(frame, 7, 5), 1.705F);
    }
    auto scan = range_scan();
    scan->rangeImage_convertToExternalStorage("gone.bin", folder.path("run_Images/"));
    FrameBuilder builder(TInputOptions(), folder.path("elsewhere.rawlog"), FrameContent::metric);
    EXPECT_EQ(builder.build(*scan).depth_defect, DepthDefect::missing_depth_image);
    EXPECT_THAT(builder.first_missing_image(), ::testing::HasSubstr("gone.bin"));
}

}  // namespace
