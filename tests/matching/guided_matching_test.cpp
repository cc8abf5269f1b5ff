// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/code_matcher.h"
#include "random_cells.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace
{
using fild::HashedFeatures;
using fild::testing::cell_codes;
using fild::testing::kColumns;
using fild::testing::kRows;
using fild::testing::moved;
using fild::testing::random_cells;

constexpr int kCellPx = 10;
constexpr int kShift = 2;  // cells to the right, from the query to the candidate
constexpr int kWords = 4;

fild::CodeMatcher guided(bool mutual = true)
{
    fild::THashingOptions options;
    options.search = fild::CodeSearch::guided;
    options.ratio = 0.9;
    options.mutual_check = mutual;
    return fild::CodeMatcher(options);
}

fild::CodeMatcher exhaustive()
{
    fild::THashingOptions options;
    options.search = fild::CodeSearch::exhaustive;
    options.ratio = 0.9;
    options.mutual_check = true;
    return fild::CodeMatcher(options);
}

HashedFeatures without_keypoints(const fild::CellCodes& cells)
{
    HashedFeatures features;
    features.image_size = {kColumns * kCellPx, kRows * kCellPx};
    features.codes.bits = 64 * kWords;
    features.codes.words_per_code = kWords;
    features.cells = cells;
    return features;
}

/** The code of keypoint `k`, in which `flipped` bits are others. */
std::vector<std::uint64_t> code_of(std::uint64_t k, int flipped = 0)
{
    std::mt19937_64 generator(k + 1000);
    std::vector<std::uint64_t> code;
    for (int w = 0; w < kWords; ++w) code.push_back(generator());
    for (int b = 0; b < flipped; ++b) code[0] ^= std::uint64_t{1} << static_cast<unsigned>(b);
    return code;
}

void add(HashedFeatures& features,
         double row,
         double column,
         const std::vector<std::uint64_t>& code)
{
    features.positions.push_back(
        {static_cast<float>(column * kCellPx), static_cast<float>(row * kCellPx)});
    features.codes.words.insert(features.codes.words.end(), code.begin(), code.end());
}

/** One keypoint in each cell of the query that the candidate still shows. */
HashedFeatures query()
{
    auto features = without_keypoints(cell_codes(random_cells(1)));
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column + kShift < kColumns; ++column)
            add(features, row + 0.4, column + 0.6, code_of(features.positions.size()));
    return features;
}

/** The query's keypoints where they have moved to, in their order; with `repeats` each stands a
 *  second time, just as well, four rows away. */
HashedFeatures candidate(bool repeats = false)
{
    auto features = without_keypoints(cell_codes(moved(random_cells(1), kShift)));
    const auto from = query();
    for (std::size_t k = 0; k < from.positions.size(); ++k)
        add(features,
            static_cast<double>(from.positions[k].y) / kCellPx,
            static_cast<double>(from.positions[k].x) / kCellPx + kShift,
            code_of(k, 20));
    for (std::size_t k = 0; repeats && k < from.positions.size(); ++k)
    {
        const double row = static_cast<double>(from.positions[k].y) / kCellPx;
        add(features,
            row < 3 ? row + 3 : row - 3,
            static_cast<double>(from.positions[k].x) / kCellPx + kShift,
            code_of(k, 20));
    }
    return features;
}

void expect_each_matches_its_own(const std::vector<fild::Match>& matches, std::size_t count)
{
    EXPECT_EQ(matches.size(), count);
    for (const auto& match : matches)
    {
        EXPECT_EQ(match.query, match.candidate);
        EXPECT_EQ(match.distance_bits, 20);
    }
}

TEST(GuidedMatching, FindsWhatHasMovedWithTheCells)
{
    const auto from = query();
    const auto matching = guided().match(from, candidate());
    expect_each_matches_its_own(matching.matches, from.positions.size());
    EXPECT_EQ(matching.compared, from.positions.size());
}

TEST(GuidedMatching, TellsRepeatedThingsApartThatAllOfTheImageDoesNot)
{
    const auto from = query();
    const auto to = candidate(true);
    EXPECT_TRUE(exhaustive().match(from, to).matches.empty());
    expect_each_matches_its_own(guided().match(from, to).matches, from.positions.size());
}

TEST(GuidedMatching, FindsNothingWhereCellsDoNotAgree)
{
    auto elsewhere = candidate();
    elsewhere.cells = cell_codes(random_cells(2));
    elsewhere.cells.codes.words.assign(elsewhere.cells.codes.words.size(), 0);
    const auto matching = guided().match(query(), elsewhere);
    EXPECT_TRUE(matching.matches.empty());
    EXPECT_EQ(matching.compared, 0U);
}

TEST(GuidedMatching, FindsNothingWithoutCells)
{
    auto without = candidate();
    without.cells = {};
    EXPECT_TRUE(guided().match(query(), without).matches.empty());
    EXPECT_TRUE(guided().match(without, query()).matches.empty());
}

TEST(GuidedMatching, DoesNotMatchALoneKeypointWithAnUnrelatedOne)
{
    auto from = without_keypoints(query().cells);
    auto to = without_keypoints(candidate().cells);
    add(from, 2.5, 2.5, code_of(1));
    add(to, 2.5, 2.5 + kShift, code_of(2));
    const auto unlike = guided().match(from, to);
    EXPECT_TRUE(unlike.matches.empty());
    EXPECT_EQ(unlike.compared, 1U);
    to.codes.words = code_of(1, 30);
    EXPECT_EQ(guided().match(from, to).matches.size(), 1U);
}

TEST(GuidedMatching, LooksNoFartherThanACellAndThreeQuarters)
{
    auto from = without_keypoints(query().cells);
    auto near = without_keypoints(candidate().cells);
    auto far = near;
    add(from, 2.5, 2.5, code_of(1));
    add(near, 2.5 + 1.69, 2.5 + kShift, code_of(1));
    add(far, 2.5 + 1.71, 2.5 + kShift, code_of(1));
    EXPECT_EQ(guided().match(from, near).matches.size(), 1U);
    EXPECT_TRUE(guided().match(from, far).matches.empty());
}

TEST(GuidedMatching, GivesAKeypointOfTheCandidateToOneOfTheQueryWithTheMutualCheckAlone)
{
    auto from = without_keypoints(query().cells);
    auto to = without_keypoints(candidate().cells);
    add(from, 2.5, 2.5, code_of(1, 30));
    add(from, 2.6, 2.6, code_of(1));
    add(to, 2.5, 2.5 + kShift, code_of(1));
    const auto mutual = guided().match(from, to).matches;
    ASSERT_EQ(mutual.size(), 1U);
    EXPECT_EQ(mutual[0].query, 1U);
    EXPECT_EQ(guided(false).match(from, to).matches.size(), 2U);
}

TEST(GuidedMatching, NeedsCodesOfOneLengthAndMoreThanCodes)
{
    auto shorter = candidate();
    shorter.codes.bits = 128;
    EXPECT_THROW(guided().match(query(), shorter), std::invalid_argument);
    EXPECT_THROW(guided().match(query().codes, candidate().codes), std::invalid_argument);
}
}  // namespace
