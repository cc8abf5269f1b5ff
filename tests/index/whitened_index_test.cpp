// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/whitened_index.h"

#include "fild/core/random.h"
#include "fild/index/exact_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace
{
using fild::FrameId;
using fild::GlobalDescriptor;

constexpr std::size_t kDimension = 24;

GlobalDescriptor normalised(GlobalDescriptor descriptor)
{
    double squares = 0;
    for (const float x : descriptor) squares += static_cast<double>(x) * x;
    for (auto& x : descriptor) x /= static_cast<float>(std::sqrt(squares));
    return descriptor;
}

/** Images of one street: a large common part, light that changes all of them alike (the first
 * number), and a little that belongs to the place. */
class Street
{
 public:
    explicit Street(std::size_t places) : generator_(7)
    {
        for (std::size_t i = 0; i < places; ++i)
        {
            GlobalDescriptor place(kDimension);
            for (auto& x : place) x = noise(0.1);
            places_.push_back(place);
        }
    }

    GlobalDescriptor view_of(std::size_t place)
    {
        auto view = places_[place];
        view[0] += noise(2);
        for (auto& x : view) x += 1 + noise(0.02);
        return normalised(view);
    }

 private:
    float noise(double sigma)
    {
        return static_cast<float>(sigma * fild::standard_normal(generator_));
    }

    std::mt19937_64 generator_;
    std::vector<GlobalDescriptor> places_;
};

std::unique_ptr<fild::WhitenedIndex> make_index(int whiten_from)
{
    fild::TIndexOptions options;
    options.whiten_from = whiten_from;
    options.whitening_shrinkage = 0.1;
    return std::make_unique<fild::WhitenedIndex>(
        options, [] { return std::make_unique<fild::ExactIndex>(kDimension); });
}

/** Share of places whose second view is answered with the first. */
double recall(int whiten_from)
{
    constexpr std::size_t kPlaces = 100;
    Street street(kPlaces);
    const auto index = make_index(whiten_from);
    for (std::size_t i = 0; i < kPlaces; ++i) index->insert(FrameId{i}, street.view_of(i));
    EXPECT_EQ(index->size(), kPlaces);
    int found = 0;
    for (std::size_t i = 0; i < kPlaces; ++i)
        found += index->search(street.view_of(i), 1).at(0).frame == FrameId{i} ? 1 : 0;
    return found / static_cast<double>(kPlaces);
}

TEST(WhitenedIndex, TellsPlacesApartThatHaveMuchInCommon)
{
    EXPECT_LT(recall(1000), 0.5);  // never learns
    EXPECT_GT(recall(30), 0.8);
}

TEST(WhitenedIndex, IsThePlainIndexBeforeItLearns)
{
    Street street(9);
    const auto whitened = make_index(10);
    fild::ExactIndex plain(kDimension);
    for (std::size_t i = 0; i < 9; ++i)
    {
        const auto view = street.view_of(i);
        whitened->insert(FrameId{i}, view);
        plain.insert(FrameId{i}, view);
    }
    const auto query = street.view_of(3);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(whitened->search(query, 9)[i].frame, plain.search(query, 9)[i].frame);
}

TEST(WhitenedIndex, AFrameIsMostSimilarToItself)
{
    Street street(80);
    const auto index = make_index(16);  // learns at 16, 32 and 64
    std::vector<GlobalDescriptor> views;
    for (std::size_t i = 0; i < 80; ++i)
    {
        views.push_back(street.view_of(i));
        index->insert(FrameId{i}, views.back());
    }
    for (const std::size_t i : {0U, 15U, 16U, 63U, 79U})
    {
        EXPECT_EQ(index->search(views[i], 1).at(0).frame, FrameId{i});
        EXPECT_NEAR(index->similarity(views[i], FrameId{i}), 1, 1e-4);
    }
    EXPECT_LT(index->similarity(views[0], FrameId{40}), 0.9);
}

/** Counts the insertions into all its like. */
class CountedIndex : public fild::ExactIndex
{
 public:
    explicit CountedIndex(std::size_t& insertions) : ExactIndex(kDimension), insertions_(insertions)
    {
    }

    void insert(FrameId frame, const GlobalDescriptor& descriptor) override
    {
        ++insertions_;
        ExactIndex::insert(frame, descriptor);
    }

 private:
    std::size_t& insertions_;
};

// Filled at once, the index of a large map would hold up the recording for minutes.
TEST(WhitenedIndex, FillsTheIndexOfALargeMapInSlices)
{
    constexpr std::size_t kLearns = 8192;
    constexpr std::size_t kIsFilled = kLearns + kLearns / 4;
    Street street(100);
    fild::TIndexOptions options;
    options.whiten_from = kLearns / 2;
    std::size_t insertions = 0;
    fild::WhitenedIndex index(options, [&] { return std::make_unique<CountedIndex>(insertions); });
    const auto query = street.view_of(3);
    double similarity = 0;
    for (std::size_t i = 0; i <= kIsFilled; ++i)
    {
        insertions = 0;
        index.insert(FrameId{i}, street.view_of(i % 100));
        const auto size = index.size();
        ASSERT_EQ(size, i + 1);
        if (size > kLearns / 2)
        {
            ASSERT_LE(insertions, 6U) << size;
        }
        const auto now = index.similarity(query, FrameId{0});
        const bool has_changed = now != std::exchange(similarity, now);
        EXPECT_EQ(has_changed, size == 1 || size == kLearns / 2 || size == kIsFilled) << size;
    }
    EXPECT_EQ(index.search(query, kIsFilled).size(), kIsFilled);
}

TEST(WhitenedIndex, BearsDescriptorsThatAreAllAlike)
{
    const auto index = make_index(4);
    const GlobalDescriptor same(kDimension, 1 / std::sqrt(static_cast<float>(kDimension)));
    for (std::size_t i = 0; i < 10; ++i) index->insert(FrameId{i}, same);
    const auto answer = index->search(same, 3);
    ASSERT_EQ(answer.size(), 3U);
    for (const auto& candidate : answer) EXPECT_FALSE(std::isnan(candidate.similarity));
}

}  // namespace
