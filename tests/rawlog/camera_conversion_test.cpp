// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/camera_conversion.h"

#include "message_of.h"

#include <mrpt/img/TCamera.h>

namespace
{
using fild::camera_model_from;
using fild::CameraModel;
using fild::LensModel;
using fild::mrpt_camera_from;

CameraModel camera(LensModel lens, const std::array<double, 8>& distortion)
{
    return {500, 501, 320.5, 240.25, 640, 480, lens, distortion};
}

void expect_equal(const CameraModel& a, const CameraModel& b)
{
    EXPECT_EQ(a.fx, b.fx);
    EXPECT_EQ(a.fy, b.fy);
    EXPECT_EQ(a.cx, b.cx);
    EXPECT_EQ(a.cy, b.cy);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.lens, b.lens);
    EXPECT_EQ(a.distortion, b.distortion);
}

TEST(CameraConversion, SurvivesARoundTripThroughMrpt)
{
    for (const auto& model :
         {camera(LensModel::none, {}),
          camera(LensModel::plumb_bob, {-0.3, 0.1, 1e-3, -2e-3, 0.05, 0.6, 0.7, 0.8}),
          camera(LensModel::kannala_brandt, {0.1, -0.02, 0.003, -0.0004})})
    {
        const auto back = camera_model_from(mrpt_camera_from(model));
        ASSERT_TRUE(back);
        expect_equal(*back, model);
    }
}

TEST(CameraConversion, TakesMrptsDefaultCameraForUncalibrated)
{
    EXPECT_FALSE(camera_model_from(mrpt::img::TCamera()));
}

TEST(CameraConversion, TakesNumbersThatAreNoneForUncalibrated)
{
    mrpt::img::TCamera camera;
    camera.setIntrinsicParamsFromValues(400, 400, 320, 240);
    EXPECT_TRUE(fild::camera_model_from(camera));
    camera.dist[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(fild::camera_model_from(camera));
}

TEST(CameraConversion, SkipsTheGapInMrptsFisheyeCoefficients)
{
    mrpt::img::TCamera fisheye;
    fisheye.setIntrinsicParamsFromValues(300, 300, 320, 240);
    fisheye.distortion = mrpt::img::DistortionModel::kannala_brandt;
    fisheye.dist = {1, 2, 99, 99, 3, 4, 99, 99};
    const auto model = camera_model_from(fisheye);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->distortion, (std::array<double, 8>{1, 2, 3, 4}));
}

}  // namespace
