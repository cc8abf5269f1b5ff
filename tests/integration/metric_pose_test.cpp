// SPDX-License-Identifier: BSD-3-Clause
// Metric loop edges on the drawn town, against the exact truth.
#include "fild/synthetic/synthetic_options.h"
#include "fild/synthetic/synthetic_recording.h"
#include "fild/synthetic/town.h"
#include "loop_edges.h"
#include "temporary_folder.h"

namespace
{
using namespace fild::testing;

/** Two laps round a small block. */
fild::TSyntheticOptions two_laps(fild::SensorKind sensor)
{
    auto options = fild::options_of(fild::Preset::tiny);
    options.sensors.sensor = sensor;
    options.sensors.width = 640;
    options.sensors.height = 480;
    return options;
}

EdgeStatistics drive(fild::SensorKind sensor)
{
    const TemporaryFolder folder;
    fild::SyntheticRequest request;
    request.rawlog_path = folder.path("town.rawlog");
    request.options = two_laps(sensor);
    fild::Town town(request.options.town);
    write_synthetic_recording(request,
                              town.grid(),
                              [&](const auto& camera, const auto& pose, const auto& conditions)
                              { return town.draw(camera, pose, conditions); },
                              {});
    const auto truth = read_tum(folder.path("town.gt.tum"));
    return edge_statistics(read_frames(request.rawlog_path),
                           truth,
                           nearest_loops(folder.path("town.loops.txt"), truth));
}

TEST(MetricPose, OfStereoPairsIsExactAndKnowsHowExact)
{
    const auto edges = drive(fild::SensorKind::stereo);
    SCOPED_TRACE(edges.text());
    ASSERT_GE(edges.errors.size(), 10U);
    EXPECT_LT(edges.median(&EdgeError::metres), 0.03);
    EXPECT_LT(edges.median(&EdgeError::degrees), 0.3);
    EXPECT_GE(edges.mean_nees(), 3);  // 4 to 9 over many edges; here are some 20
    EXPECT_LE(edges.mean_nees(), 9.5);
    EXPECT_EQ(edges.share_beyond(), 0);
}

TEST(MetricPose, OfRangeScansIsExactAndKnowsHowExact)
{
    const auto edges = drive(fild::SensorKind::rgbd);
    SCOPED_TRACE(edges.text());
    ASSERT_GE(edges.errors.size(), 10U);
    EXPECT_LT(edges.median(&EdgeError::metres), 0.02);
    EXPECT_LT(edges.median(&EdgeError::degrees), 0.3);
    EXPECT_GE(edges.mean_nees(), 3);  // 4 to 9 over many edges; here are some 20
    EXPECT_LE(edges.mean_nees(), 9.5);
    EXPECT_EQ(edges.share_beyond(), 0);
}

}  // namespace
