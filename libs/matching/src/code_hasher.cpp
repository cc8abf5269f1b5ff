// SPDX-License-Identifier: BSD-3-Clause
// Hash codes of FILD (An et al., IROS 2019), Eq. (5), after CasHash (Cheng et al., CVPR 2014).
#include "fild/matching/code_hasher.h"

#include "fild/core/parallel_for.h"
#include "fild/core/random.h"
#include "processor_clones.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
constexpr std::size_t kWordBits = 64;
constexpr std::size_t kFeaturesPerTask = 64;

/** So many projections of a descriptor are summed side by side, in registers. */
constexpr std::size_t kLanes = 8;
constexpr std::size_t kVectors = 4;
constexpr std::size_t kPanelWidth = kLanes * kVectors;
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;

/** The descriptor's projections by one panel: sum of x[i] times row i of the panel. Without fused
 *  multiply-adds, whose other rounding would give other codes on other processors. */
[[gnu::always_inline]] inline void project(const float* x, const float* panel, float* projections)
{
    Lanes sums[kVectors] = {};
    for (std::size_t i = 0; i < LocalFeatures::dimension; ++i)
        for (std::size_t v = 0; v < kVectors; ++v, panel += kLanes)
        {
            Lanes row;
            std::memcpy(&row, panel, sizeof(row));
            sums[v] += x[i] * row;
        }
    std::memcpy(projections, sums, sizeof(sums));
}

/** Projections of `count` descriptors that stand one after the other: row by row, `panels` x
 *  kPanelWidth numbers each. Panel by panel, because one panel stays in the nearest cache. */
FILD_CLONED_FOR("avx2")
void project_all(const float* descriptors,
                 std::size_t count,
                 const std::vector<float>& weights,
                 std::vector<float>& projections)
{
    constexpr auto kPanelSize = LocalFeatures::dimension * kPanelWidth;
    const auto panels = weights.size() / kPanelSize;
    projections.resize(count * panels * kPanelWidth);
    for (std::size_t p = 0; p < panels; ++p)
        for (std::size_t i = 0; i < count; ++i)
            project(descriptors + i * LocalFeatures::dimension,
                    weights.data() + p * kPanelSize,
                    projections.data() + (i * panels + p) * kPanelWidth);
}

std::size_t panels_for(std::size_t projections)
{
    return (projections + kPanelWidth - 1) / kPanelWidth;
}

/** Independent normal numbers, drawn for one number of the descriptor after the other and divided
 *  by its deviation; the columns that fill up the last panel are zero. */
std::vector<float> random_panels(std::size_t projections,
                                 const std::vector<float>& deviation,
                                 std::uint64_t seed)
{
    std::vector<float> weights(panels_for(projections) * kPanelWidth * LocalFeatures::dimension, 0);
    std::mt19937_64 generator(seed);
    for (std::size_t i = 0; i < LocalFeatures::dimension; ++i)
        for (std::size_t s = 0; s < projections; ++s)
        {
            const auto row = s / kPanelWidth * LocalFeatures::dimension + i;
            weights[row * kPanelWidth + s % kPanelWidth] =
                static_cast<float>(standard_normal(generator)) / deviation[i];
        }
    return weights;
}

const std::vector<float>& deviation_of(const DescriptorStatistics& typical)
{
    for (const auto* numbers : {&typical.mean, &typical.deviation})
        if (numbers->size() != LocalFeatures::dimension)
            throw std::invalid_argument("CodeHasher: statistics of " +
                                        std::to_string(numbers->size()) + " numbers, not " +
                                        std::to_string(LocalFeatures::dimension));
    return typical.deviation;
}

/** Signed square roots of one descriptor's numbers, of unit norm. */
void root(const float* descriptor, float* rooted)
{
    float sum = 0;
    for (std::size_t i = 0; i < LocalFeatures::dimension; ++i)
    {
        rooted[i] = std::copysign(std::sqrt(std::abs(descriptor[i])), descriptor[i]);
        sum += std::abs(descriptor[i]);
    }
    const float norm = sum > 0 ? std::sqrt(sum) : 1;
    for (std::size_t i = 0; i < LocalFeatures::dimension; ++i) rooted[i] /= norm;
}

std::vector<float> rooted(const float* descriptors, std::size_t count)
{
    std::vector<float> roots(count * LocalFeatures::dimension);
    for (std::size_t i = 0; i < roots.size(); i += LocalFeatures::dimension)
        root(descriptors + i, roots.data() + i);
    return roots;
}
}  // namespace

CodeHasher::CodeHasher(const THashingOptions& options,
                       const DescriptorStatistics& typical,
                       std::uint64_t seed)
    : rooted_(options.rooted),
      bits_(options.bits),
      tables_(options.search == CodeSearch::cascade ? options.tables : 0),
      bucket_bits_(options.bucket_bits),
      projections_(static_cast<std::size_t>(bits_ + tables_ * bucket_bits_)),
      weights_(random_panels(projections_, deviation_of(typical), seed))
{
    options.check();
    project_all(typical.mean.data(), 1, weights_, thresholds_);
}

void CodeHasher::store(const float* projections, std::size_t feature, BinaryCodes& codes) const
{
    const auto is_set = [&](std::size_t s) { return projections[s] > thresholds_[s]; };
    const auto bits = static_cast<std::size_t>(bits_);
    auto* word = codes.words.data() + feature * static_cast<std::size_t>(codes.words_per_code);
    for (std::size_t s = 0; s < bits; ++s)
        word[s / kWordBits] |= std::uint64_t{is_set(s)} << (s % kWordBits);
    auto* bucket = codes.buckets.data() + feature * static_cast<std::size_t>(tables_);
    std::size_t s = bits;
    for (int table = 0; table < tables_; ++table)
        for (int b = 0; b < bucket_bits_; ++b, ++s)
            if (is_set(s)) bucket[table] |= static_cast<std::uint16_t>(1U << unsigned(b));
}

BinaryCodes CodeHasher::hash(const LocalFeatures& features, int num_threads) const
{
    BinaryCodes codes;
    codes.bits = bits_;
    codes.words_per_code =
        static_cast<int>((static_cast<std::size_t>(bits_) + kWordBits - 1) / kWordBits);
    codes.tables = tables_;
    codes.words.resize(features.size() * static_cast<std::size_t>(codes.words_per_code));
    codes.buckets.resize(features.size() * static_cast<std::size_t>(tables_));

    const auto hash_some = [&](std::size_t task)
    {
        const auto begin = task * kFeaturesPerTask;
        const auto count = std::min(kFeaturesPerTask, features.size() - begin);
        const float* descriptors = features.descriptor(begin);
        std::vector<float> roots;
        if (rooted_) roots = rooted(descriptors, count);
        std::vector<float> projections;
        project_all(rooted_ ? roots.data() : descriptors, count, weights_, projections);
        for (std::size_t i = 0; i < count; ++i)
            store(projections.data() + i * thresholds_.size(), begin + i, codes);
    };
    const auto tasks = (features.size() + kFeaturesPerTask - 1) / kFeaturesPerTask;
    parallel_for(num_threads, tasks, hash_some);
    return codes;
}

}  // namespace fild
