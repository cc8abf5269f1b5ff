// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/place_index.h"

#include "fild/core/random.h"
#include "fild/index/exact_index.h"
#include "fild/index/hnsw_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{
using fild::Candidate;
using fild::FrameId;
using fild::GlobalDescriptor;

constexpr std::size_t kDimension = 32;

std::vector<GlobalDescriptor> random_unit_vectors(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    std::vector<GlobalDescriptor> vectors(count, GlobalDescriptor(kDimension));
    for (auto& vector : vectors)
    {
        double squares = 0;
        for (auto& x : vector)
        {
            x = static_cast<float>(fild::standard_normal(generator));
            squares += static_cast<double>(x) * x;
        }
        for (auto& x : vector) x /= static_cast<float>(std::sqrt(squares));
    }
    return vectors;
}

double cosine(const GlobalDescriptor& a, const GlobalDescriptor& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
    return sum;
}

/** The similarities of the `count` nearest, by comparing with everything. */
std::vector<double> brute_force(const std::vector<GlobalDescriptor>& all,
                                const GlobalDescriptor& query,
                                std::size_t count)
{
    std::vector<double> similarities;
    similarities.reserve(all.size());
    for (const auto& vector : all) similarities.push_back(cosine(vector, query));
    std::sort(similarities.rbegin(), similarities.rend());
    similarities.resize(std::min(count, similarities.size()));
    return similarities;
}

fild::TIndexOptions options_of(fild::IndexBackend backend)
{
    fild::TIndexOptions options;
    options.backend = backend;
    options.construction_width = 200;
    options.search_width = 100;
    return options;
}

class BothIndexes : public ::testing::TestWithParam<fild::IndexBackend>
{
 protected:
    std::unique_ptr<fild::PlaceIndex> index_ =
        fild::make_place_index(options_of(GetParam()), kDimension, 1);

    void insert_all(const std::vector<GlobalDescriptor>& vectors)
    {
        for (std::size_t i = 0; i < vectors.size(); ++i) index_->insert(FrameId{i}, vectors[i]);
    }
};

TEST_P(BothIndexes, AnswerNothingWhenEmpty)
{
    EXPECT_TRUE(index_->search(random_unit_vectors(1, 1)[0], 5).empty());
    EXPECT_EQ(index_->size(), 0U);
}

TEST_P(BothIndexes, AnswerAllWhenAskedForMoreThanThereAre)
{
    insert_all(random_unit_vectors(3, 1));
    EXPECT_EQ(index_->search(random_unit_vectors(1, 2)[0], 10).size(), 3U);
    EXPECT_TRUE(index_->search(random_unit_vectors(1, 2)[0], 0).empty());
}

TEST_P(BothIndexes, AgreeWithBruteForceAcrossGrowth)
{
    const auto vectors = random_unit_vectors(2500, 1);  // beyond the first capacity, twice
    insert_all(vectors);
    EXPECT_EQ(index_->size(), vectors.size());
    int nearest_found = 0;
    for (const auto& query : random_unit_vectors(100, 2))
    {
        const auto expected = brute_force(vectors, query, 5);
        const auto answer = index_->search(query, 5);
        ASSERT_EQ(answer.size(), 5U);
        for (const auto& candidate : answer)
            EXPECT_NEAR(
                candidate.similarity, cosine(vectors[to_index(candidate.frame)], query), 1e-5);
        nearest_found += std::abs(answer[0].similarity - expected[0]) < 1e-5 ? 1 : 0;
    }
    EXPECT_GE(nearest_found, 99);
}

TEST_P(BothIndexes, FindAnInsertedVectorWithSimilarityOne)
{
    const auto vectors = random_unit_vectors(200, 3);
    insert_all(vectors);
    const auto answer = index_->search(vectors[77], 1);
    ASSERT_EQ(answer.size(), 1U);
    EXPECT_EQ(answer[0].frame, FrameId{77});
    EXPECT_NEAR(answer[0].similarity, 1.0, 1e-5);
}

TEST_P(BothIndexes, AnswerMostSimilarFirstAndDuplicatesByFrame)
{
    const auto vectors = random_unit_vectors(2, 4);
    insert_all({vectors[0], vectors[1], vectors[0], vectors[0]});
    const auto answer = index_->search(vectors[0], 4);
    ASSERT_EQ(answer.size(), 4U);
    EXPECT_EQ(answer[0].frame, FrameId{0});
    EXPECT_EQ(answer[1].frame, FrameId{2});
    EXPECT_EQ(answer[2].frame, FrameId{3});
    EXPECT_EQ(answer[3].frame, FrameId{1});
}

TEST_P(BothIndexes, TellHowSimilarOneFrameIs)
{
    const auto vectors = random_unit_vectors(50, 8);
    insert_all(vectors);
    const auto query = random_unit_vectors(1, 9)[0];
    for (const auto& candidate : index_->search(query, 5))
        EXPECT_NEAR(index_->similarity(query, candidate.frame), candidate.similarity, 1e-6);
    EXPECT_NEAR(index_->similarity(query, FrameId{49}), cosine(query, vectors[49]), 1e-5);
    EXPECT_THROW(index_->similarity(query, FrameId{50}), std::invalid_argument);
}

TEST_P(BothIndexes, RefuseAnotherDimension)
{
    constexpr int kNever = 0;
    const auto vectors = random_unit_vectors(6, 1);
    for (const int whiten_from : {kNever, 4})
    {
        auto options = options_of(GetParam());
        options.whiten_from = whiten_from;
        const auto index = fild::make_place_index(options, kDimension, 1);
        for (std::size_t i = 0; i < vectors.size(); ++i)
        {
            index->insert(FrameId{i}, vectors[i]);
            for (const auto length : {kDimension - 1, kDimension + 1})
            {
                const GlobalDescriptor other(length);
                EXPECT_THROW(index->insert(FrameId{10 + i}, other), std::invalid_argument);
                EXPECT_THROW(index->search(other, 1), std::invalid_argument);
                EXPECT_THROW(index->similarity(other, FrameId{0}), std::invalid_argument);
            }
        }
        EXPECT_EQ(index->size(), vectors.size());
    }
}

INSTANTIATE_TEST_SUITE_P(PlaceIndex,
                         BothIndexes,
                         ::testing::Values(fild::IndexBackend::hnsw, fild::IndexBackend::exact),
                         [](const auto& backend)
                         { return backend.param == fild::IndexBackend::hnsw ? "Hnsw" : "Exact"; });

/** Share of queries whose nearest neighbour is the true one. */
double recall(const fild::TIndexOptions& options)
{
    const auto vectors = random_unit_vectors(2000, 5);
    fild::HnswIndex index(options, kDimension, 1);
    for (std::size_t i = 0; i < vectors.size(); ++i) index.insert(FrameId{i}, vectors[i]);
    const auto queries = random_unit_vectors(200, 6);
    int found = 0;
    for (const auto& query : queries)
        found += std::abs(index.search(query, 1)[0].similarity -
                          brute_force(vectors, query, 1)[0]) < 1e-5
                     ? 1
                     : 0;
    return found / static_cast<double>(queries.size());
}

TEST(HnswIndex, HonoursEachOfItsThreeParameters)
{
    fild::TIndexOptions narrow;
    narrow.links_per_node = 4;
    narrow.construction_width = 10;
    narrow.search_width = 5;
    const double base = recall(narrow);
    auto wider_search = narrow;
    wider_search.search_width = 100;
    auto wider_construction = narrow;
    wider_construction.construction_width = 200;
    auto more_links = narrow;
    more_links.links_per_node = 24;
    EXPECT_GT(recall(wider_search), base + 0.1);
    EXPECT_GT(recall(wider_construction), base + 0.02);
    EXPECT_GT(recall(more_links), base + 0.02);
}

TEST(HnswIndex, RepeatsWithTheSeed)
{
    const auto vectors = random_unit_vectors(500, 7);
    fild::TIndexOptions options;
    fild::HnswIndex a(options, kDimension, 9);
    fild::HnswIndex b(options, kDimension, 9);
    for (std::size_t i = 0; i < vectors.size(); ++i)
    {
        a.insert(FrameId{i}, vectors[i]);
        b.insert(FrameId{i}, vectors[i]);
        const auto answer_a = a.search(vectors[i / 2], 3);
        const auto answer_b = b.search(vectors[i / 2], 3);
        ASSERT_EQ(answer_a.size(), answer_b.size());
        for (std::size_t k = 0; k < answer_a.size(); ++k)
        {
            EXPECT_EQ(answer_a[k].frame, answer_b[k].frame);
            EXPECT_EQ(answer_a[k].similarity, answer_b[k].similarity);
        }
    }
}

}  // namespace
