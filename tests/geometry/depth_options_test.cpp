// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/depth_options.h"

#include "fild/geometry/relative_pose_options.h"
#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

namespace
{
using fild::testing::message_of;
using mrpt::config::CConfigFileMemory;
using ::testing::HasSubstr;

TEST(DepthOptions, SurviveARoundTrip)
{
    fild::TDepthOptions options;
    options.patch_px = 15;
    options.min_parallax_deg = 2.5;
    CConfigFileMemory saved;
    options.saveToConfigFile(saved, "depth");
    fild::TDepthOptions loaded;
    loaded.loadFromConfigFile(CConfigFileMemory(saved.getContent()), "depth");
    EXPECT_EQ(loaded.values(), options.values());
}

TEST(DepthOptions, RefuseUnknownKeysAndAnEvenPatch)
{
    fild::TDepthOptions options;
    EXPECT_THROW(
        options.loadFromConfigFile(CConfigFileMemory(std::string("[depth]\npatch = 3\n")), "depth"),
        std::runtime_error);
    options.patch_px = 10;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                HasSubstr("patch_px=10 is not odd"));
    options.patch_px = 11;
    options.min_depth_m = 0;
    EXPECT_THROW(options.check(), std::invalid_argument);
}

TEST(RelativePoseOptions, SurviveARoundTrip)
{
    fild::TRelativePoseOptions options;
    options.min_points = 20;
    CConfigFileMemory saved;
    options.saveToConfigFile(saved, "relative_pose");
    fild::TRelativePoseOptions loaded;
    loaded.loadFromConfigFile(CConfigFileMemory(saved.getContent()), "relative_pose");
    EXPECT_EQ(loaded.values(), options.values());
}

}  // namespace
