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
}

TEST(InputOptions, SurviveARoundTripThroughText)
{
    const auto options = load(
        "sensor_label=CAM.*\nimages_dir=/data/my images\non_missing_image=stop\n"
        "undistort=false\ncamera_parameters=500 500 320 240 640 480\n"
        "max_entry_megabytes=2000\n");
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
