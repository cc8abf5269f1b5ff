// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/delay_queue.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace
{
fild::TIndexOptions delay(double seconds, double frame_rate = 0)
{
    fild::TIndexOptions options;
    options.delay_seconds = seconds;
    options.frame_rate = frame_rate;
    return options;
}

/** Numbers of the frames that leave the queue when frame i enters at times[i]. */
std::vector<std::vector<std::uint64_t>> released(fild::DelayQueue queue,
                                                 const std::vector<double>& times)
{
    std::vector<std::vector<std::uint64_t>> result;
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        result.emplace_back();
        for (const auto& entry : queue.push({fild::FrameId{i}, times[i], {}, "A"}))
            result.back().push_back(to_index(entry.frame));
    }
    return result;
}

using Releases = std::vector<std::vector<std::uint64_t>>;

TEST(DelayQueue, ReleasesByAgeInSeconds)
{
    EXPECT_EQ(released(fild::DelayQueue(delay(2)), {0, 1, 2, 3}), (Releases{{}, {}, {0}, {1}}));
}

TEST(DelayQueue, ReleasesSeveralAfterAPause)
{
    EXPECT_EQ(released(fild::DelayQueue(delay(2)), {0, 1, 1.5, 60}),
              (Releases{{}, {}, {}, {0, 1, 2}}));
}

TEST(DelayQueue, ReleasesByFramesWhateverTheTimesSay)
{
    EXPECT_EQ(released(fild::DelayQueue(delay(2, 1.5)), {0, 100, 200, 300, 400}),
              (Releases{{}, {}, {}, {0}, {1}}));
}

// RIGHT takes turns with LEFT, and then says no more.
TEST(DelayQueue, CountsTheFramesOfEachCamera)
{
    fild::DelayQueue queue(delay(2, 1));
    Releases releases;
    std::uint64_t frame = 0;
    for (const std::string camera :
         {"LEFT", "RIGHT", "LEFT", "RIGHT", "LEFT", "RIGHT", "LEFT", "LEFT"})
    {
        releases.emplace_back();
        for (const auto& entry : queue.push({fild::FrameId{frame++}, 0, {}, camera}))
            releases.back().push_back(to_index(entry.frame));
    }
    EXPECT_EQ(releases, (Releases{{}, {}, {}, {}, {0, 1}, {}, {2, 3}, {4, 5}}));
}

TEST(DelayQueue, NeverReleasesTheCurrentFrame)
{
    EXPECT_EQ(released(fild::DelayQueue(delay(0)), {0, 0, 5}), (Releases{{}, {0}, {1}}));
}

TEST(DelayQueue, RefusesTimeThatGoesBackwards)
{
    fild::DelayQueue queue(delay(1));
    queue.push({fild::FrameId{0}, 5, {}, "A"});
    EXPECT_THROW(queue.push({fild::FrameId{1}, 4.9, {}, "A"}), std::invalid_argument);
}

}  // namespace
