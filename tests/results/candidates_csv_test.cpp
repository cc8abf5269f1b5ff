// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/candidates_csv.h"

#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

fild::AnswersOfFrames read(const std::string& rows, std::size_t frames)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(
        folder.path("candidates.csv"),
        "frame,rank,candidate,similarity,checked,matches,inliers,rejection,support\n" + rows);
    return fild::read_candidates_csv(folder.path("candidates.csv"), frames);
}

std::string error_of(const std::string& rows)
{
    return message_of<std::runtime_error>([&] { read(rows, 10); });
}

TEST(ReadCandidatesCsv, ReadsAnswersOfFrames)
{
    const auto answers = read(
        "3,1,0,0.9,1,80,10,too_few_inliers,0\n3,2,1,0.8,0,0,0,,0\n3,,2,0.7,1,70,60,,0\n"
        "5,1,2,-0.5,0,,,,0\n5,13,4,-0.6,1,,,too_few_matches,0\n",
        6);
    ASSERT_EQ(answers.size(), 6U);
    EXPECT_TRUE(answers[0].empty());
    ASSERT_EQ(answers[3].size(), 3U);
    EXPECT_EQ(answers[3][0].rank, 1U);
    EXPECT_EQ(answers[3][0].candidate.frame, fild::FrameId{0});
    EXPECT_DOUBLE_EQ(answers[3][0].candidate.similarity, 0.9);
    EXPECT_TRUE(answers[3][0].checked);
    EXPECT_EQ(answers[3][0].matches, 80U);
    EXPECT_EQ(answers[3][0].inliers, 10U);
    EXPECT_EQ(answers[3][0].rejection, fild::Rejection::too_few_inliers);
    EXPECT_FALSE(answers[3][1].checked);
    EXPECT_EQ(answers[3][2].rank, 0U);
    EXPECT_EQ(answers[3][2].rejection, fild::Rejection::none);
    ASSERT_EQ(answers[5].size(), 2U);
    EXPECT_EQ(answers[5][1].rank, 13U) << "verified because its cells agree";
}

TEST(ReadCandidatesCsv, RefusesRowsThatAreNoAnswers)
{
    EXPECT_THAT(error_of("10,1,0,0.9,0,0,0,,0\n"), HasSubstr("line 2: frame 10, the run has 10"));
    EXPECT_THAT(error_of("3,1,3,0.9,0,0,0,,0\n"), HasSubstr("not an earlier frame"));
    EXPECT_THAT(error_of("3,1,0,0.9,0,0,0,,0\n3,1,1,0.9,0,0,0,,0\n"),
                HasSubstr("line 3: rank 1 comes after rank 1"));
    EXPECT_THAT(error_of("3,12,0,0.9,1,0,0,,0\n3,2,1,0.9,0,0,0,,0\n"),
                HasSubstr("line 3: rank 2 comes after rank 12"));
    EXPECT_THAT(error_of("3,1,0,0.9,2,0,0,,0\n"), HasSubstr("checked: '2'"));
    EXPECT_THAT(error_of("3,,0,0.9,0,0,0,,0\n"), HasSubstr("neither an answer"));
    EXPECT_THAT(error_of("3,1,0,0.9,1,0,0,dull,0\n"), HasSubstr("'dull'"));
    EXPECT_THAT(error_of("3,1,0,alike,1,0,0,,0\n"), HasSubstr("'alike' is not a number"));
    EXPECT_THAT(error_of("3,1,0\n"), HasSubstr("3 columns instead of 9"));
}

TEST(ReadCandidatesCsv, RefusesAnotherHeader)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("candidates.csv"), "frame,rank\n");
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] { fild::read_candidates_csv(folder.path("candidates.csv"), 1); }),
                HasSubstr("header of candidates.csv"));
}

}  // namespace
