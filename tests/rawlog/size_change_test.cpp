// SPDX-License-Identifier: BSD-3-Clause
// Images of other sizes of one camera. A dot is drawn where a camera sees a point in space; after
// the change the camera of the frame must see the point where the dot then is.
#include "drawn_rawlog.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/frame_builder.h"

#include <gtest/gtest.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::CameraModel;
using fild::DepthDefect;
using fild::Frame;
using fild::FrameBuilder;
using fild::FrameContent;
using fild::Rejection;
using fild::TInputOptions;

const cv::Size kFirst(320, 240);

CameraModel camera_of(cv::Size size, double focal)
{
    CameraModel camera;
    camera.fx = focal;
    camera.fy = 1.02 * focal;
    camera.cx = 0.51 * size.width;
    camera.cy = 0.48 * size.height;
    camera.width = size.width;
    camera.height = size.height;
    return camera;
}

cv::Point2d seen_at(const CameraModel& camera, const cv::Vec3d& point)
{
    return {camera.fx * point[0] / point[2] + camera.cx,
            camera.fy * point[1] / point[2] + camera.cy};
}

cv::Mat image_of(const CameraModel& camera, const cv::Vec3d& point, int type = CV_8UC1)
{
    cv::Mat image(camera.height, camera.width, type, cv::Scalar::all(0));
    const auto at = seen_at(camera, point) * 16.0;  // 4 bits of sub-pixels
    const int radius = camera.width / 40 * 16;
    cv::circle(image, cv::Point(at), radius, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA, 4);
    return image;
}

/** Centre of the brightness. */
cv::Point2d dot_in(const cv::Mat& image)
{
    cv::Mat grey = image;
    if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    const auto m = cv::moments(grey);
    return {m.m10 / m.m00, m.m01 / m.m00};
}

mrpt::obs::CObservationImage::Ptr image_through(const CameraModel& camera,
                                                const cv::Vec3d& point,
                                                double seconds)
{
    auto observation = image_observation(image_of(camera, point), seconds);
    observation->cameraParams = mrpt_camera_from(camera);
    return observation;
}

mrpt::img::CImage to_image(const cv::Mat& pixels)
{
    return {pixels, mrpt::img::DEEP_COPY};
}

mrpt::obs::CObservationStereoImages::Ptr stereo_through(const CameraModel& camera,
                                                        const cv::Vec3d& point,
                                                        double seconds)
{
    constexpr double kBaseline = 0.2;
    auto stereo = mrpt::obs::CObservationStereoImages::Create();
    stereo->timestamp = mrpt::Clock::fromDouble(seconds);
    stereo->imageLeft = to_image(image_of(camera, point));
    stereo->imageRight = to_image(image_of(camera, point - cv::Vec3d(kBaseline, 0, 0)));
    stereo->hasImageRight = true;
    stereo->leftCamera = stereo->rightCamera = mrpt_camera_from(camera);
    stereo->rightCameraPose =
        mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(kBaseline, 0, 0, 0, 0, 0));
    return stereo;
}

/** Depths of 1 m, and of 3 m where the dot is. */
mrpt::obs::CObservation3DRangeScan::Ptr range_scan_through(const CameraModel& camera,
                                                           const cv::Vec3d& point,
                                                           double seconds)
{
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->timestamp = mrpt::Clock::fromDouble(seconds);
    scan->hasIntensityImage = scan->hasRangeImage = true;
    const auto image = image_of(camera, point);
    scan->intensityImage = to_image(image);
    scan->cameraParams = scan->cameraParamsIntensity = mrpt_camera_from(camera);
    scan->rangeUnits = 0.001F;
    scan->rangeImage_setSize(camera.height, camera.width);
    for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column)
            scan->rangeImage(row, column) = image.at<std::uint8_t>(row, column) > 127 ? 3000 : 1000;
    return scan;
}

FrameBuilder metric_builder(const TInputOptions& options = {})
{
    return FrameBuilder(options, "/nowhere/run.rawlog", FrameContent::metric);
}

const cv::Vec3d kPoint(0.1, -0.15, 2);

/** The second frame of a camera whose first has the size kFirst. */
template <class Through>
Frame second_frame(Through&& through, const CameraModel& second, const TInputOptions& options = {})
{
    auto builder = metric_builder(options);
    builder.build(*through(camera_of(kFirst, 200), kPoint, 1));
    return builder.build(*through(second, kPoint, 2));
}

double miss(const Frame& frame)
{
    return cv::norm(dot_in(frame.image) - seen_at(*frame.camera, kPoint));
}

TEST(SizeChange, ScalesImageAndCamera)
{
    for (const auto& size : {cv::Size(160, 120), cv::Size(500, 375), cv::Size(640, 475)})
    {
        const auto frame = second_frame(image_through, camera_of(size, 300));
        EXPECT_EQ(frame.defect, Rejection::none);
        EXPECT_EQ(frame.image.size(), kFirst);
        ASSERT_TRUE(frame.camera);
        EXPECT_EQ(cv::Size(frame.camera->width, frame.camera->height), kFirst);
        EXPECT_LT(miss(frame), 0.15) << size;
    }
}

TEST(SizeChange, CutsWhatOverhangs)
{
    for (const auto& size : {cv::Size(640, 360), cv::Size(240, 240)})
    {
        const auto frame = second_frame(image_through, camera_of(size, 300));
        EXPECT_EQ(frame.image.size(), kFirst);
        ASSERT_TRUE(frame.camera);
        EXPECT_LT(miss(frame), 0.15) << size;
        EXPECT_NEAR(frame.camera->fy / frame.camera->fx, 1.02, 0.005) << "nothing is stretched";
    }
}

TEST(SizeChange, ScalesTheRightImageAsTheLeft)
{
    const auto frame = second_frame(stereo_through, camera_of({640, 480}, 430));
    ASSERT_TRUE(frame.right) << to_word(frame.depth_defect);
    EXPECT_LT(miss(frame), 0.15);
    EXPECT_EQ(frame.right->image.size(), kFirst);
    const auto in_right = frame.right->left_from_right.inverse() * kPoint;
    EXPECT_LT(cv::norm(dot_in(frame.right->image) - seen_at(frame.right->camera, in_right)), 0.15);
    EXPECT_NEAR(frame.right->camera.fx, frame.camera->fx, 1e-9);
}

TEST(SizeChange, DoesNotCutTheRightImage)
{
    const auto frame = second_frame(stereo_through, camera_of({640, 360}, 430));
    ASSERT_TRUE(frame.right);
    EXPECT_EQ(frame.image.size(), kFirst);
    EXPECT_EQ(frame.right->image.size(), cv::Size(427, 240));
    EXPECT_EQ(frame.right->camera.width, 427);
    const auto in_right = frame.right->left_from_right.inverse() * kPoint;
    EXPECT_LT(cv::norm(dot_in(frame.right->image) - seen_at(frame.right->camera, in_right)), 0.15);
}

TEST(SizeChange, TakesDepthsAlongWithoutMixingThem)
{
    for (const auto& size : {cv::Size(640, 480), cv::Size(160, 120), cv::Size(640, 360)})
    {
        const auto frame = second_frame(range_scan_through, camera_of(size, 300));
        ASSERT_EQ(frame.depth.size(), kFirst) << to_word(frame.depth_defect);
        const cv::Mat far = frame.depth > 2.999;
        const cv::Mat between = (frame.depth > 1.001) & (frame.depth < 2.999);
        EXPECT_EQ(cv::countNonZero(between), 0);
        EXPECT_LT(cv::norm(dot_in(far) - dot_in(frame.image)), 0.5) << size;
    }
}

TEST(SizeChange, TakesCameraParametersOfTheFirstSizeForOthers)
{
    TInputOptions options;
    options.camera_parameters = "200 204 163.2 115.2 320 240";
    const auto frame = second_frame(stereo_through, camera_of({640, 480}, 430), options);
    ASSERT_TRUE(frame.camera);
    EXPECT_NEAR(frame.camera->fx, 200, 1e-9);
    EXPECT_NEAR(frame.camera->cx, 163.2, 1e-9);
    ASSERT_TRUE(frame.right);
    EXPECT_NEAR(frame.right->camera.fx, 200, 1e-9);
}

TEST(SizeChange, DropsACalibrationThatCannotBeMeant)
{
    TInputOptions options;
    options.camera_parameters = "200 204 163.2 115.2 320 240";
    const auto cut = second_frame(stereo_through, camera_of({640, 360}, 430), options);
    EXPECT_EQ(cut.defect, Rejection::none) << "loops are found without";
    EXPECT_FALSE(cut.camera);
    EXPECT_EQ(cut.depth_defect, DepthDefect::not_calibrated);

    const auto other_size = [](const CameraModel& camera, const cv::Vec3d& point, double seconds)
    {
        auto stereo = stereo_through(camera, point, seconds);
        if (seconds > 1) stereo->rightCamera.ncols = 1000;
        return stereo;
    };
    const auto frame = second_frame(other_size, camera_of({640, 480}, 430));
    EXPECT_TRUE(frame.camera);
    EXPECT_FALSE(frame.right);
    EXPECT_EQ(frame.depth_defect, DepthDefect::not_calibrated);
}

TEST(SizeChange, RejectsAnotherShapeAndExtremeScales)
{
    for (const auto& size : {cv::Size(240, 320),
                             cv::Size(520, 240),
                             cv::Size(32, 24),
                             cv::Size(3200, 2400),
                             cv::Size(1, 1)})
    {
        const auto frame = second_frame(image_through, camera_of(size, 300));
        EXPECT_EQ(frame.defect, Rejection::image_size_changed) << size;
        EXPECT_TRUE(frame.image.empty());
    }
}

TEST(SizeChange, LetsGreyAndColourMix)
{
    auto builder = metric_builder();
    builder.build(*image_observation(draw_image(CV_8UC3), 1));
    const auto grey = builder.build(*image_observation(draw_image(CV_8UC1, 0, {128, 96}), 2));
    EXPECT_EQ(grey.image.type(), CV_8UC1);
    const auto colour = builder.build(*image_observation(draw_image(CV_8UC3, 0, {128, 96}), 3));
    EXPECT_EQ(colour.image.type(), CV_8UC3);
    EXPECT_EQ(builder.scaled_frames(), 2U);
}

TEST(SizeChange, OfEachCameraIsToItsOwnFirstImage)
{
    TInputOptions options;
    options.sensor_label = "A|B";
    FrameBuilder builder(options, "run.rawlog");
    builder.build(*image_observation(draw_image(), 1, "A"));
    const auto other = image_observation(draw_image(CV_8UC1, 0, {128, 96}), 1, "B");
    EXPECT_EQ(builder.build(*other).image.size(), cv::Size(128, 96));
    EXPECT_EQ(builder.scaled_frames(), 0U);
}

TEST(SizeChange, IsTheSameWhenTheFirstFramesAreSkipped)
{
    FrameBuilder builder(TInputOptions(), "run.rawlog");
    builder.skip(*external_observation("none.png", 0));
    builder.skip(*image_observation(draw_image(), 1));
    builder.skip(*image_observation(draw_image(CV_8UC1, 0, {32, 24}), 2));
    const auto frame = builder.build(*image_observation(draw_image(CV_8UC1, 0, {128, 96}), 3));
    EXPECT_EQ(frame.image.size(), cv::Size(64, 48));
}

}  // namespace
