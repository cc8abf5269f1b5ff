// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_labels.h"

#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

fild::LoopLabels read_list(const std::string& text)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("loops.txt"), text);
    return fild::read_loop_list(folder.path("loops.txt"));
}

TEST(LoopLabels, GroupsPairsByQuery)
{
    const auto labels = fild::to_loop_labels({{5, 1}, {4, 0}, {5, 0}, {5, 1}}, 6);
    EXPECT_THAT(labels.earlier_frames,
                ElementsAre(Pair(4, ElementsAre(0)), Pair(5, ElementsAre(0, 1))));
    EXPECT_EQ(labels.pairs, 3U);
    EXPECT_EQ(labels.frames, 6U);
    EXPECT_FALSE(labels.transposed);
}

TEST(LoopLabels, KeepsDoubtfulPairsOfAListApart)
{
    const auto labels = read_list("3 0 0\n4 0\n4 1 0\n");
    EXPECT_THAT(labels.earlier_frames, ElementsAre(Pair(4, ElementsAre(0))));
    EXPECT_THAT(labels.doubtful, ElementsAre(Pair(3, 0), Pair(4, 1)));
    EXPECT_THAT(message_of<std::runtime_error>([] { read_list("4 0 2\n"); }),
                HasSubstr("QUERY CANDIDATE"));
}

TEST(LoopLabels, SwapsWhatIsStoredTransposed)
{
    const auto labels = fild::to_loop_labels({{0, 4}, {1, 5}, {3, 2}}, 6);
    EXPECT_TRUE(labels.transposed);
    // (3, 2) is above the diagonal now: a label error, whose query remains
    EXPECT_THAT(
        labels.earlier_frames,
        ElementsAre(Pair(2, ElementsAre()), Pair(4, ElementsAre(0)), Pair(5, ElementsAre(1))));
    EXPECT_EQ(labels.dropped, 1U);
}

TEST(LoopLabels, DropsLaterFramesAndKeepsTheirQuery)
{
    const auto labels = fild::to_loop_labels({{0, 3}, {4, 5}, {4, 1}, {5, 2}, {5, 1}}, 6);
    EXPECT_THAT(
        labels.earlier_frames,
        ElementsAre(Pair(0, ElementsAre()), Pair(4, ElementsAre(1)), Pair(5, ElementsAre(1, 2))));
    EXPECT_EQ(labels.dropped, 2U);
    EXPECT_EQ(labels.unanswerable_queries(), 1U);
    EXPECT_EQ(labels.pairs, 3U);
}

TEST(LoopLabels, TakesASymmetricMatrixOnce)
{
    const auto labels = fild::to_loop_labels({{4, 0}, {0, 4}, {0, 0}, {4, 4}}, 5);
    EXPECT_THAT(labels.earlier_frames, ElementsAre(Pair(4, ElementsAre(0))));
    EXPECT_EQ(labels.mirrored, 1U);
    EXPECT_EQ(labels.on_diagonal, 2U);
    EXPECT_EQ(labels.dropped, 0U);
    EXPECT_FALSE(labels.transposed);
}

TEST(ReadLoopList, PassesOverCommentsAndBlankLines)
{
    const auto labels = read_list("# query match\n\n4 0\r\n  5\t1 \n");
    EXPECT_THAT(labels.earlier_frames,
                ElementsAre(Pair(4, ElementsAre(0)), Pair(5, ElementsAre(1))));
    EXPECT_FALSE(labels.frames);
}

TEST(ReadLoopList, NamesTheLineThatIsWrong)
{
    EXPECT_THAT(message_of<std::runtime_error>([] { read_list("4 0\n5\n"); }),
                HasSubstr("line 2: 1 number"));
    EXPECT_THAT(message_of<std::runtime_error>([] { read_list("4 x\n"); }),
                HasSubstr("'x' is not a number"));
    EXPECT_THAT(message_of<std::runtime_error>([] { read_list("4 0.5\n"); }),
                HasSubstr("line 1: 0.5"));
    EXPECT_THAT(message_of<std::runtime_error>([] { read_list("4 -1\n"); }),
                HasSubstr("no frame number"));
    EXPECT_THAT(message_of<std::runtime_error>([] { fild::read_loop_list("no/such"); }),
                HasSubstr("no/such"));
}

}  // namespace
