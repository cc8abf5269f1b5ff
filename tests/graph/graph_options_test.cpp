// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/graph_options.h"

#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

namespace
{
using fild::TGraphOptions;
using fild::testing::message_of;
using ::testing::HasSubstr;

TGraphOptions parsed(const std::string& text)
{
    TGraphOptions options;
    options.loadFromConfigFile(mrpt::config::CConfigFileMemory("[graph]\n" + text), "graph");
    return options;
}

TEST(GraphOptions, DefaultsAreValidAndSurviveARoundTrip)
{
    TGraphOptions options;
    EXPECT_NO_THROW(options.check());
    options.motion_sources = "gps,vision";
    options.odometry_covariance = fild::OdometryCovariance::own;
    options.graph_dimensions = fild::GraphDimensions::planar;
    options.trajectory_format = fild::TrajectoryFormat::kitti;
    options.drift_percent = 0.37;
    mrpt::config::CConfigFileMemory saved;
    options.saveToConfigFile(saved, "graph");
    TGraphOptions again;
    again.loadFromConfigFile(mrpt::config::CConfigFileMemory(saved.getContent()), "graph");
    EXPECT_EQ(again.values(), options.values());
}

TEST(GraphOptions, SayWhatIsWrong)
{
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("drift = 1"); }),
                HasSubstr("[graph] unknown key 'drift'"));
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("drift_percent = 0"); }),
                HasSubstr("drift_percent=0 outside"));
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("graph_dimensions = 4d"); }),
                HasSubstr("one of: 2d, 3d"));
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("pairwise_confidence = 1"); }),
                HasSubstr("pairwise_confidence=1 outside"));
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("motion_sources = gps, wheels"); }),
                HasSubstr("'wheels' is not one of odometry, vision, gps"));
    EXPECT_THAT(message_of<std::runtime_error>([] { parsed("motion_sources ="); }),
                HasSubstr("names no source"));
}

TEST(GraphOptions, NameTheSourcesOfMotion)
{
    const auto all = TGraphOptions().sources();
    EXPECT_TRUE(all.odometry && all.vision && all.gps);
    const auto two = parsed("motion_sources = gps, odometry").sources();
    EXPECT_TRUE(two.odometry && two.gps);
    EXPECT_FALSE(two.vision);
}

TEST(GraphOptions, NeedAReasonForKeyframes)
{
    EXPECT_THAT(message_of<std::runtime_error>(
                    [] { parsed("keyframe_distance_m = 0\nkeyframe_angle_deg = 0"); }),
                HasSubstr("there would be no keyframes"));
    EXPECT_NO_THROW(
        parsed("keyframe_distance_m = 0\nkeyframe_angle_deg = 0\nkeyframe_seconds = 2"));
}

}  // namespace
