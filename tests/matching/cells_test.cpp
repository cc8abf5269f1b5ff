// SPDX-License-Identifier: BSD-3-Clause
#include "code_distance.h"
#include "fild/matching/cell_motion.h"
#include "random_cells.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace
{
using fild::CellCodes;
using fild::CellFeatures;
using fild::testing::cell_codes;
using fild::testing::code_distance;
using fild::testing::kChannels;
using fild::testing::kColumns;
using fild::testing::kRows;
using fild::testing::moved;
using fild::testing::random_cells;

std::size_t agreeing_cells(const CellCodes& query, const CellCodes& candidate)
{
    return fild::cell_motion(query, candidate).agreeing();
}

/** The same cells in a random order. */
CellFeatures shuffled(const CellFeatures& cells, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    auto result = cells;
    for (std::size_t i = cells.size() - 1; i > 0; --i)
        for (std::size_t c = 0, j = generator() % (i + 1); c < kChannels; ++c)
            std::swap(result.values[i * kChannels + c], result.values[j * kChannels + c]);
    return result;
}

TEST(CellHasher, MakesACodeForEachCellFromItsNumbersAndTheSeed)
{
    const auto cells = random_cells(1);
    const auto codes = cell_codes(cells);
    EXPECT_EQ(codes.rows, kRows);
    EXPECT_EQ(codes.columns, kColumns);
    EXPECT_EQ(codes.codes.size(), cells.size());
    EXPECT_EQ(codes.codes.bits, 256);
    EXPECT_EQ(codes.codes.words, cell_codes(cells).codes.words);
    EXPECT_NE(codes.codes.words, fild::hash_cells(cells, 256, 2).codes.words);
}

// P(bit differs) = angle / pi for random hyperplanes (Charikar, STOC 2002).
TEST(CellHasher, OppositeCellsHaveOppositeCodesAndStrangersDifferInHalfTheBits)
{
    const auto cells = random_cells(1);
    auto opposite = cells;
    for (auto& x : opposite.values) x = -x;
    const auto codes = cell_codes(cells).codes;
    const auto other = cell_codes(opposite).codes;
    int between_strangers = 0;
    for (std::size_t i = 0; i + 1 < codes.size(); ++i)
    {
        EXPECT_EQ(code_distance(codes, i, other, i), 256);
        between_strangers += code_distance(codes, i, codes, i + 1);
    }
    EXPECT_NEAR(between_strangers / static_cast<double>(codes.size() - 1), 128, 10);
}

TEST(CellHasher, MakesNoCodesOfNoCells)
{
    EXPECT_EQ(fild::hash_cells({}, 256, 1).codes.size(), 0U);
}

TEST(CellMotion, AreAllOfTheSameView)
{
    const auto codes = cell_codes(random_cells(1));
    EXPECT_EQ(agreeing_cells(codes, codes), codes.codes.size());
}

TEST(CellMotion, AreThoseThatAViewFromTheSideStillShows)
{
    const auto cells = random_cells(1);
    const auto there = cell_codes(moved(cells, 2));
    EXPECT_GE(agreeing_cells(cell_codes(cells), there),
              static_cast<std::size_t>(kRows * (kColumns - 2)) - 2);
    EXPECT_LE(agreeing_cells(cell_codes(cells), there),
              static_cast<std::size_t>(kRows * (kColumns - 2)) + 2);
}

TEST(CellMotion, AreFewWhereTheSameThingsStandInAnotherOrder)
{
    const auto cells = random_cells(1);
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        EXPECT_LE(agreeing_cells(cell_codes(cells), cell_codes(shuffled(cells, seed))), 15U)
            << "of 48, seed " << seed;
}

TEST(CellMotion, AreFewInStrangePlacesAndInFeaturelessOnes)
{
    EXPECT_LE(agreeing_cells(cell_codes(random_cells(1)), cell_codes(random_cells(2))), 6U);
    const CellFeatures wall{
        kRows, kColumns, kChannels, std::vector<float>(random_cells(1).values.size())};
    EXPECT_LE(agreeing_cells(cell_codes(wall), cell_codes(wall)), 1U);
}

TEST(CellMotion, AreNoneWithoutCells)
{
    const auto codes = cell_codes(random_cells(1));
    EXPECT_EQ(agreeing_cells({}, codes), 0U);
    EXPECT_EQ(agreeing_cells(codes, {}), 0U);
}

TEST(CellMotion, CompareMapsOfOtherSizes)
{
    auto smaller = cell_codes(random_cells(1));
    smaller.rows = 4;
    smaller.codes.words.resize(4 * kColumns * 4);
    EXPECT_EQ(agreeing_cells(smaller, cell_codes(random_cells(1))), 32U);
    EXPECT_EQ(agreeing_cells(cell_codes(random_cells(1)), smaller), 32U);
}

TEST(CellMotion, RefuseCodesOfAnotherLength)
{
    const auto codes = cell_codes(random_cells(1));
    EXPECT_THROW(agreeing_cells(codes, fild::hash_cells(random_cells(1), 128, 1)),
                 std::invalid_argument);
}
}  // namespace
