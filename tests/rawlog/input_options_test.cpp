// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/input_options.h"

#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

namespace
{
using fild::OnMissingImage;
using fild::TInputOptions;
using fild::testing::message_of;
using mrpt::config::CConfigFileMemory;
using ::testing::AllOf;
using ::testing::HasSubstr;

TInputOptions load(const std::string& body)
{
    TInputOptions options;
    options.loadFromConfigFile(CConfigFileMemory("[input]\n" + body), "input");
    return options;
}

std::string load_error(const std::string& body)
{
    return message_of<std::runtime_error>([&] { load(body); });
}

TEST(InputOptions, TakeTheFirstCameraAndSkipMissingImagesByDefault)
{
    const auto options = load("");
    EXPECT_EQ(options.sensor_label, "");
    EXPECT_EQ(options.images_dir, "");
    EXPECT_EQ(options.on_missing_image, OnMissingImage::skip);
    EXPECT_TRUE(options.undistort);
    EXPECT_EQ(options.camera_parameters, "");
    EXPECT_EQ(options.max_entry_megabytes, 256);
    EXPECT_TRUE(options.finds_pairs());
    EXPECT_EQ(options.stereo_tolerance_seconds, 0.02);
}

TEST(InputOptions, NameTheTwoCamerasOfAPair)
{
    const auto pair = load("stereo_labels = CAMERA_LEFT, CAMERA_RIGHT\n").named_pair();
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->left, "CAMERA_LEFT");
    EXPECT_EQ(pair->right, "CAMERA_RIGHT");
    const auto none = load("stereo_labels = none\n");
    EXPECT_FALSE(none.named_pair());
    EXPECT_FALSE(none.finds_pairs());
    for (const auto* bad : {"LEFT", "LEFT,", ",RIGHT", "A,B,C", "A,A", "None"})
        EXPECT_THAT(load_error(std::string("stereo_labels = ") + bad + "\n"),
                    HasSubstr(std::string("stereo_labels='") + bad + "' is neither LEFT,RIGHT"));
    EXPECT_THAT(load_error("sensor_label = RIGHT\nstereo_labels = LEFT,RIGHT\n"),
                HasSubstr("sensor_label='RIGHT' does not take the left camera"));
    EXPECT_THAT(load_error("stereo_tolerance_seconds = -1\n"), HasSubstr("outside [0, 1]"));
}

TEST(InputOptions, SurviveARoundTripThroughText)
{
    const auto options = load(
        "sensor_label=CAM.*\nimages_dir=/data/my images\non_missing_image=stop\n"
        "undistort=false\ncamera_parameters=500 500 320 240 640 480\n"
        "max_entry_megabytes=2000\nstereo_labels=CAM1,CAM2\nstereo_tolerance_seconds=0.1\n");
    EXPECT_EQ(options.max_entry_megabytes, 2000);
    EXPECT_EQ(options.on_missing_image, OnMissingImage::stop);
    EXPECT_FALSE(options.undistort);
    CConfigFileMemory saved;
    options.saveToConfigFile(saved, "input");
    TInputOptions again;
    again.loadFromConfigFile(CConfigFileMemory(saved.getContent()), "input");
    EXPECT_EQ(again.values(), options.values());
}

TEST(InputOptions, NameTheKeyOfABadValue)
{
    EXPECT_THAT(load_error("sensor_label=CAM(\n"),
                AllOf(HasSubstr("[input] sensor_label='CAM('"), HasSubstr("regular expression")));
    EXPECT_THAT(load_error("on_missing_image=ignore\n"), HasSubstr("skip, stop"));
    EXPECT_THAT(load_error("undistort=1\n"), HasSubstr("undistort"));
    EXPECT_THAT(load_error("max_entry_megabytes=0\n"), HasSubstr("max_entry_megabytes"));
    EXPECT_THAT(load_error("camera_parameters=500 500\n"),
                HasSubstr("[input] camera_parameters: expected"));
    EXPECT_THAT(load_error("camera_parameters=a b c d e f\n"), HasSubstr("not a number"));
    EXPECT_THAT(load_error("label=CAM\n"), HasSubstr("unknown key 'label'"));
}

}  // namespace
