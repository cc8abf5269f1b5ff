// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_labels.h"
#include "mat_file.h"
#include "message_of.h"
#include "temporary_folder.h"

#include <filesystem>
#include <limits>
#include <sys/resource.h>

namespace
{
using fild::testing::Cells;
using fild::testing::MatFile;
using fild::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

/** Frames 4 and 5 come back to frames 0 and 1. */
const Cells kLoops = {{4, 0}, {5, 0}, {5, 1}};

class ReadLoopMatrix : public ::testing::Test
{
 protected:
    std::string path() const { return folder_.path("truth.mat"); }

    void expect_the_loops() const
    {
        const auto labels = fild::read_loop_matrix(path());
        EXPECT_THAT(labels.earlier_frames,
                    ElementsAre(Pair(4, ElementsAre(0)), Pair(5, ElementsAre(0, 1))));
        EXPECT_EQ(labels.frames, 6U);
        EXPECT_FALSE(labels.transposed);
    }

    std::string error() const
    {
        return message_of<std::runtime_error>([this] { fild::read_loop_matrix(path()); });
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

TEST_F(ReadLoopMatrix, OfDoubles)
{
    MatFile(path()).full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops, 0.5);
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, OfBytes)
{
    MatFile(path()).full<std::uint8_t>("GT", MAT_C_UINT8, MAT_T_UINT8, 6, 6, kLoops);
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, OfLogicals)
{
    MatFile(path()).full<std::uint8_t>(
        "GT", MAT_C_UINT8, MAT_T_UINT8, 6, 6, kLoops, 1, MAT_F_LOGICAL);
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, OfOtherNumbers)
{
    MatFile(path()).full<float>("GT", MAT_C_SINGLE, MAT_T_SINGLE, 6, 6, kLoops, -0.1F);
    expect_the_loops();
    MatFile(path()).full<std::int8_t>("GT", MAT_C_INT8, MAT_T_INT8, 6, 6, kLoops, -1);
    expect_the_loops();
    MatFile(path()).full<std::int16_t>("GT", MAT_C_INT16, MAT_T_INT16, 6, 6, kLoops, 256);
    expect_the_loops();
    MatFile(path()).full<std::uint32_t>("GT", MAT_C_UINT32, MAT_T_UINT32, 6, 6, kLoops, 1U << 16U);
    expect_the_loops();
    MatFile(path()).full<std::int64_t>(
        "GT", MAT_C_INT64, MAT_T_INT64, 6, 6, kLoops, std::int64_t{1} << 32U);
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, Sparse)
{
    MatFile(path()).sparse("GT", 6, kLoops, false);
    expect_the_loops();
    MatFile(path()).sparse("GT", 6, kLoops, true);
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, Transposed)
{
    MatFile(path()).full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, {{0, 4}, {0, 5}, {1, 5}});
    const auto labels = fild::read_loop_matrix(path());
    EXPECT_TRUE(labels.transposed);
    EXPECT_THAT(labels.earlier_frames,
                ElementsAre(Pair(4, ElementsAre(0)), Pair(5, ElementsAre(0, 1))));
}

TEST_F(ReadLoopMatrix, BesideOtherVariables)
{
    {
        MatFile file(path());
        file.text("author", "somebody");
        file.full<double>("scale", MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, {{0, 0}});
        file.full<double>("times", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 1, {});
        file.full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops);
    }
    expect_the_loops();
}

TEST_F(ReadLoopMatrix, RefusesTwoMatricesAndNone)
{
    {
        MatFile file(path());
        file.full<double>("before", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops);
        file.full<double>("after", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops);
    }
    EXPECT_THAT(error(), HasSubstr("more than one matrix"));
    EXPECT_THAT(error(), HasSubstr("before (6x6), after (6x6)"));
    MatFile(path()).text("author", "somebody");
    EXPECT_THAT(error(), HasSubstr("no matrix of real numbers"));
    EXPECT_THAT(error(), HasSubstr("author (1x8)"));
}

TEST_F(ReadLoopMatrix, RefusesNonsense)
{
    MatFile(path()).full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 5, kLoops);
    EXPECT_THAT(error(), HasSubstr("GT (6x5)"));
    MatFile(path()).full<double>(
        "GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops, std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(error(), HasSubstr("not a number"));
    fild::testing::write_text(path(), "no MATLAB file, but a text that is long enough for one");
    EXPECT_THAT(error(), HasSubstr(path()));
}

/** The system refuses it to the attempt, and matio goes on as at the end of the file. */
TEST_F(ReadLoopMatrix, TakesNoMoreMemoryThanItsAttemptMay)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers' own memory counts";
#endif
    MatFile(path()).full<double>("loops", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, kLoops);
    auto bytes = fild::testing::read_text(path());
    const auto length_of_name = bytes.find("loops") - 4;
    bytes[length_of_name + 3] = 0x60;  // 1.6 GB
    fild::testing::write_text(path(), bytes);
    EXPECT_THAT(error(), HasSubstr("holds no matrix"));
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss / 1024, 1000);
}

TEST_F(ReadLoopMatrix, RefusesAFileThatIsCutOff)
{
    MatFile(path()).full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 60, 60, kLoops);
    std::filesystem::resize_file(path(), 4000);
    EXPECT_THAT(error(), HasSubstr("cut off"));
}

}  // namespace
