// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/local_feature_options.h"

#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

namespace
{
using fild::TLocalFeatureOptions;
using fild::testing::message_of;
using mrpt::config::CConfigFileMemory;
using ::testing::HasSubstr;

TLocalFeatureOptions load(const std::string& body)
{
    TLocalFeatureOptions options;
    options.loadFromConfigFile(CConfigFileMemory("[local_features]\n" + body), "local_features");
    return options;
}

std::string load_error(const std::string& body)
{
    return message_of<std::runtime_error>([&] { load(body); });
}

TEST(LocalFeatureOptions, DefaultToThePapersScaleSpace)
{
    const auto options = load("");
    EXPECT_EQ(options.hessian_threshold, 100);
    EXPECT_EQ(options.octaves, 4);
    EXPECT_EQ(options.layers_per_octave, 2);
    EXPECT_FALSE(options.upright);
    EXPECT_EQ(options.max_keypoints, 0);
    EXPECT_NO_THROW(options.check());
}

TEST(LocalFeatureOptions, RefuseValuesOutOfRange)
{
    EXPECT_THAT(load_error("hessian_threshold=-1\n"), HasSubstr("hessian_threshold=-1 outside"));
    EXPECT_THAT(load_error("octaves=0\n"), HasSubstr("octaves=0 outside [1, 6]"));
    EXPECT_THAT(load_error("octaves=7\n"), HasSubstr("octaves=7"));
    EXPECT_THAT(load_error("layers_per_octave=0\n"), HasSubstr("layers_per_octave=0"));
    EXPECT_THAT(load_error("layers_per_octave=6\n"), HasSubstr("layers_per_octave=6"));
    EXPECT_THAT(load_error("max_keypoints=-5\n"), HasSubstr("max_keypoints=-5"));
    EXPECT_THAT(load_error("min_keypoints=9\nmax_keypoints=8\n"),
                HasSubstr("min_keypoints=9 is above max_keypoints=8"));
}

TEST(LocalFeatureOptions, RefuseWhatIsNoValueAndUnknownKeys)
{
    EXPECT_THAT(load_error("octaves=four\n"), HasSubstr("octaves='four'"));
    EXPECT_THAT(load_error("upright=yes\n"), HasSubstr("one of: true, false"));
    EXPECT_THAT(load_error("hesian_threshold=1\n"), HasSubstr("unknown key 'hesian_threshold'"));
}

TEST(LocalFeatureOptions, SurviveARoundTripThroughText)
{
    const auto options = load(
        "hessian_threshold=12.5\noctaves=3\nlayers_per_octave=4\nupright=true\nmax_keypoints=9\n");
    CConfigFileMemory saved;
    options.saveToConfigFile(saved, "local_features");
    TLocalFeatureOptions again;
    again.loadFromConfigFile(CConfigFileMemory(saved.getContent()), "local_features");
    EXPECT_EQ(again.values(), options.values());
    EXPECT_EQ(again.max_keypoints, 9);
    EXPECT_TRUE(again.upright);
}

}  // namespace
