// SPDX-License-Identifier: BSD-3-Clause
// The published loop matrices: as many loop queries as their users report.
#include "fild/evaluation/loop_labels.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace
{
struct Published
{
    const char* file;
    std::size_t frames;
    std::size_t loop_queries;
    std::size_t dropped = 0;
    bool transposed = false;
};

void PrintTo(const Published& published, std::ostream* out)
{
    *out << published.file;
}

class PublishedMatrix : public ::testing::TestWithParam<Published>
{
};

TEST_P(PublishedMatrix, HasItsLoopQueries)
{
    const auto path = std::string(FILD_TEST_DATA_DIR "/ground_truth/") + GetParam().file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
    const auto labels = fild::read_loop_matrix(path);
    EXPECT_EQ(labels.frames, GetParam().frames);
    EXPECT_EQ(labels.earlier_frames.size(), GetParam().loop_queries);
    EXPECT_EQ(labels.dropped, GetParam().dropped);
    EXPECT_EQ(labels.transposed, GetParam().transposed);
    EXPECT_EQ(labels.mirrored + labels.on_diagonal, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Sets,
    PublishedMatrix,
    ::testing::Values(Published{"assigning_visual_words/groundTruth_KITTI00.mat", 4541, 788},
                      Published{"assigning_visual_words/groundTruth_KITTI_05.mat", 2761, 415},
                      // 482, and frame 0, whose three entries are all above the diagonal
                      Published{"assigning_visual_words/groundTruth_MALAGA_6L.mat", 3474, 483, 3},
                      Published{"botw/groundTruthKITTI00.mat", 4541, 851},
                      Published{"botw/groundTruthKITTI05.mat", 2761, 479},
                      Published{"botw/groundTruthMalaga6L.mat", 3474, 707},
                      Published{"botw/groundTruthNC.mat", 2624, 1334},
                      Published{"kn_zhang/groundTruth_KITTI00.mat", 4541, 788},
                      Published{"kn_zhang/groundTruth_KITTI_05.mat", 2761, 415},
                      Published{"kn_zhang/malaga_GT_final.mat", 3474, 722},
                      Published{"kn_zhang/newcollege_GT.mat", 2624, 1333, 0, true}));

}  // namespace
