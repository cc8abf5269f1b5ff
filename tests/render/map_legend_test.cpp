// SPDX-License-Identifier: BSD-3-Clause
#include "map_legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace
{
using ::testing::ElementsAre;

/** Frames every 100 m along a line. */
fild::DrawnMap map_of(std::size_t frames)
{
    fild::DrawnMap map;
    for (std::size_t i = 0; i < frames; ++i)
        map.optimized.push_back(
            {fild::FrameId{i}, {cv::Matx33d::eye(), {100 * static_cast<double>(i), 0, 0}}});
    return map;
}

TEST(MapLegend, SaysWhichLengthIsTheTrueOne)
{
    auto map = map_of(3);
    EXPECT_THAT(fild::lengths_of({map, {}}), ElementsAre("3 frames", "path of 200 m"));
    map.ground_truth = {{0, 0, 0}, {150, 0, 0}, {150, 60, 0}};
    EXPECT_THAT(fild::lengths_of({map, {}}),
                ElementsAre("3 frames", "path of 200 m", "true path of 210 m"));
}

}  // namespace
