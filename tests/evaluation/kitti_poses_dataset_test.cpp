// SPDX-License-Identifier: BSD-3-Clause
// Loops by distance on whole sequences: about as many as people labelled.
#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/loop_score.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace
{
std::size_t loop_queries_by_distance(const std::string& poses, std::size_t count)
{
    std::vector<fild::FrameVerdict> frames(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        frames[i].frame = fild::FrameId{i};
        frames[i].timestamp = 0.1 * static_cast<double>(i);
        frames[i].rejection = fild::Rejection::too_few_matches;
    }
    const auto loaded = fild::load_ground_truth(poses, frames, fild::parse_protocol("radius:5"));
    return fild::score_loops(fild::judge_frames(frames, *loaded.truth)).loop_queries;
}

TEST(KittiPoses, GiveAboutAsManyLoopQueriesAsLabels)
{
    const std::string folder = FILD_TEST_DATA_DIR "/ground_truth/kitti_poses/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is missing";
    const auto queries_00 = loop_queries_by_distance(folder + "00.txt", 4541);
    EXPECT_GE(queries_00, 750U);  // published: 788 and 851
    EXPECT_LE(queries_00, 851U);
    const auto queries_05 = loop_queries_by_distance(folder + "05.txt", 2761);
    EXPECT_GE(queries_05, 415U);  // published: 415 and 479
    EXPECT_LE(queries_05, 479U);
}

}  // namespace
