// SPDX-License-Identifier: BSD-3-Clause
// Lens distortion of frames: a straight grid of dots is drawn where the lens would show it, by the
// lens equations written out here, and must come back straight.
#include "drawn_rawlog.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/frame_builder.h"
#include "message_of.h"

#include <mrpt/img/TCamera.h>

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::CameraModel;
using fild::FrameBuilder;
using fild::LensModel;
using fild::TInputOptions;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kWidth = 320;
constexpr int kHeight = 240;

CameraModel camera(LensModel lens, const std::array<double, 8>& distortion)
{
    return {220, 225, 158.5, 121.5, kWidth, kHeight, lens, distortion};
}

const CameraModel kPlumbBob = camera(LensModel::plumb_bob, {-0.28, 0.07, 0.002, -0.001, 0.01});
const CameraModel kFisheye = camera(LensModel::kannala_brandt, {-0.05, 0.02, -0.01, 0.002});

/** Where the lens puts a point of the straight image. */
cv::Point2d distorted(const CameraModel& c, const cv::Point2d& pixel)
{
    const double x = (pixel.x - c.cx) / c.fx;
    const double y = (pixel.y - c.cy) / c.fy;
    const double r2 = x * x + y * y;
    const auto& d = c.distortion;
    double u = x;
    double v = y;
    if (c.lens == LensModel::plumb_bob)
    {
        const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
        u = x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x);
        v = y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y;
    }
    else if (const double r = std::sqrt(r2); r > 0)
    {
        const double a = std::atan(r);
        const double a2 = a * a;
        const double bent = a * (1 + a2 * (d[0] + a2 * (d[1] + a2 * (d[2] + a2 * d[3]))));
        u = x * bent / r;
        v = y * bent / r;
    }
    return {c.fx * u + c.cx, c.fy * v + c.cy};
}

std::vector<cv::Point2d> grid()
{
    std::vector<cv::Point2d> points;
    for (int x = 40; x <= 280; x += 40)
        for (int y = 40; y <= 200; y += 40) points.emplace_back(x, y);
    return points;
}

cv::Mat draw_through_lens(const CameraModel& c)
{
    cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
    for (const auto& point : grid())
    {
        const auto at = distorted(c, point) * 16.0;  // 4 bits of sub-pixels
        cv::circle(image, cv::Point(at), 4 * 16, cv::Scalar(255), cv::FILLED, cv::LINE_AA, 4);
    }
    return image;
}

/** Centre of the brightness around a point. */
cv::Point2d dot_near(const cv::Mat& image, const cv::Point2d& point)
{
    const cv::Rect around(cvRound(point.x) - 12, cvRound(point.y) - 12, 25, 25);
    const auto m = cv::moments(image(around));
    return {around.x + m.m10 / m.m00, around.y + m.m01 / m.m00};
}

double largest_offset(const cv::Mat& image)
{
    double largest = 0;
    for (const auto& point : grid())
        largest = std::max(largest, cv::norm(dot_near(image, point) - point));
    return largest;
}

mrpt::obs::CObservationImage::Ptr seen_through(const CameraModel& lens, double seconds = 0)
{
    auto observation = image_observation(draw_through_lens(lens), seconds);
    observation->cameraParams = fild::mrpt_camera_from(lens);
    return observation;
}

fild::Frame build(const mrpt::obs::CObservation::Ptr& observation,
                  const TInputOptions& options = {})
{
    return FrameBuilder(options, "run.rawlog").build(*observation);
}

TEST(Undistortion, StraightensWhatTheLensBent)
{
    for (const auto& lens : {kPlumbBob, kFisheye})
    {
        ASSERT_GT(largest_offset(draw_through_lens(lens)), 2.0) << "the lens bends enough";
        const auto frame = build(seen_through(lens));
        EXPECT_LT(largest_offset(frame.image), 0.25);
        ASSERT_TRUE(frame.camera);
        EXPECT_EQ(frame.camera->lens, LensModel::none);
        EXPECT_EQ(frame.camera->distortion, (std::array<double, 8>{}));
        EXPECT_DOUBLE_EQ(frame.camera->fy, lens.fy);
    }
}

TEST(Undistortion, DoesNotTakeAFisheyeWithoutCoefficientsForAPinhole)
{
    const auto equidistant = camera(LensModel::kannala_brandt, {});
    ASSERT_GT(largest_offset(draw_through_lens(equidistant)), 2.0);
    const auto frame = build(seen_through(equidistant));
    EXPECT_LT(largest_offset(frame.image), 0.25);
    ASSERT_TRUE(frame.camera);
    EXPECT_EQ(frame.camera->lens, LensModel::none);
}

TEST(Undistortion, FollowsACameraThatChanges)
{
    FrameBuilder builder(TInputOptions(), "run.rawlog");
    EXPECT_LT(largest_offset(builder.build(*seen_through(kPlumbBob, 0)).image), 0.25);
    EXPECT_LT(largest_offset(builder.build(*seen_through(kFisheye, 1)).image), 0.25);
}

TEST(Undistortion, OfCamerasInTurnsIsByTheirOwnLenses)
{
    TInputOptions options;
    options.sensor_label = "LEFT|RIGHT";
    FrameBuilder builder(options, "run.rawlog");
    for (int i = 0; i < 3; ++i)
        for (const bool is_left : {true, false})
        {
            const auto observation = seen_through(is_left ? kPlumbBob : kFisheye, i);
            observation->sensorLabel = is_left ? "LEFT" : "RIGHT";
            EXPECT_LT(largest_offset(builder.build(*observation).image), 0.25);
        }
}

TEST(Undistortion, IsLeftOutWhereToldSo)
{
    TInputOptions options;
    options.undistort = false;
    const auto frame = build(seen_through(kPlumbBob), options);
    EXPECT_EQ(cv::norm(frame.image, draw_through_lens(kPlumbBob), cv::NORM_INF), 0);
    ASSERT_TRUE(frame.camera);
    EXPECT_EQ(frame.camera->lens, LensModel::plumb_bob);
    EXPECT_EQ(frame.camera->distortion, kPlumbBob.distortion);
}

TEST(Undistortion, DoesNotTouchAnImageWithoutDistortion)
{
    const auto observation = seen_through(camera(LensModel::plumb_bob, {}));
    for (const bool undistort : {true, false})
    {
        TInputOptions options;
        options.undistort = undistort;
        const auto frame = build(observation, options);
        EXPECT_EQ(frame.image.data, observation->image.asCvMatRef().data) << "not even copied";
        ASSERT_TRUE(frame.camera);
        EXPECT_EQ(frame.camera->lens, LensModel::none) << "a pinhole either way";
    }
}

TEST(Undistortion, UsesTheCameraOfTheOptionsInsteadOfTheObservations)
{
    auto observation = seen_through(kPlumbBob);
    observation->cameraParams = fild::mrpt_camera_from(kFisheye);
    TInputOptions options;
    options.camera_parameters = "220 225 158.5 121.5 320 240 -0.28 0.07 0.002 -0.001 0.01";
    const auto frame = build(observation, options);
    EXPECT_LT(largest_offset(frame.image), 0.25);
}

TEST(Undistortion, IsLeftOutWhereTheCalibrationIsForAnotherImageSize)
{
    auto observation = seen_through(kPlumbBob);
    observation->cameraParams.ncols = 640;
    fild::FrameBuilder builder(TInputOptions(), "run.rawlog");
    const auto frame = builder.build(*observation);
    EXPECT_FALSE(frame.camera);
    EXPECT_THAT(
        builder.calibration_notes(),
        ::testing::ElementsAre(AllOf(
            HasSubstr("640x240"), HasSubstr("320x240"), HasSubstr("[input] camera_parameters"))));
}

}  // namespace
