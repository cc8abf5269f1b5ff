// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/camera_model.h"

#include "message_of.h"

namespace
{
using fild::parse_camera_model;
using fild::testing::message_of;
using ::testing::HasSubstr;

TEST(ParseCameraModel, ReadsAPinhole)
{
    const auto camera = parse_camera_model("500 501 320.5 240.5 640 480", "calib.txt");
    EXPECT_DOUBLE_EQ(camera.fy, 501);
    EXPECT_DOUBLE_EQ(camera.cx, 320.5);
    EXPECT_EQ(camera.height, 480);
    EXPECT_EQ(camera.lens, fild::LensModel::none);
}

TEST(ParseCameraModel, ReadsDistortionInOpenCvOrder)
{
    const auto camera = parse_camera_model("500 501 320 240 640 480 -0.3 0.1 1e-4 -2e-4 0.05", "c");
    EXPECT_EQ(camera.lens, fild::LensModel::plumb_bob);
    EXPECT_DOUBLE_EQ(camera.distortion[0], -0.3);
    EXPECT_DOUBLE_EQ(camera.distortion[3], -2e-4);
    EXPECT_DOUBLE_EQ(camera.distortion[4], 0.05);
}

TEST(ParseCameraModel, NamesTheOriginOfBadText)
{
    const auto error = [](const std::string& text)
    { return message_of<std::runtime_error>([&] { parse_camera_model(text, "calib.txt"); }); };
    EXPECT_THAT(error(""), HasSubstr("calib.txt: expected"));
    EXPECT_THAT(error("1 2 3 4 5 6 7"), HasSubstr("got 7 numbers"));
    EXPECT_THAT(error("1 2 3 4 5 six"), HasSubstr("'six' is not a number"));
    EXPECT_THAT(error("0 2 3 4 5 6"), HasSubstr("must be positive"));
    for (const std::string size : {"5 0", "-5 6", "640.5 480", "1e300 480"})
        EXPECT_THAT(error("1 2 3 4 " + size), HasSubstr("whole numbers of pixels"));
}

}  // namespace
