// SPDX-License-Identifier: BSD-3-Clause
// Hash codes of FILD (An et al., IROS 2019), Eq. (5), after CasHash (Cheng et al., CVPR 2014).
#include "fild/matching/code_hasher.h"

#include "fild/core/parallel_for.h"
#include "fild/core/random.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr std::size_t kWordBits = 64;
constexpr std::size_t kFeaturesPerTask = 64;

/** Sums row i of `weights` times x[i] over i: the projections of x. */
std::vector<float> project(const float* x,
                           const std::vector<float>& weights,
                           std::size_t projections)
{
    std::vector<float> sums(projections, 0.0F);
    const float* row = weights.data();
    for (std::size_t i = 0; i < LocalFeatures::dimension; ++i, row += projections)
        for (std::size_t s = 0; s < projections; ++s) sums[s] += x[i] * row[s];
    return sums;
}

bool bit_at(const std::vector<std::uint64_t>& words, std::size_t bit)
{
    return ((words[bit / kWordBits] >> (bit % kWordBits)) & 1U) != 0;
}
}  // namespace

CodeHasher::CodeHasher(const THashingOptions& options,
                       const std::vector<float>& centre,
                       std::uint64_t seed)
    : bits_(options.bits),
      tables_(options.search == CodeSearch::cascade ? options.tables : 0),
      bucket_bits_(options.bucket_bits),
      projections_(static_cast<std::size_t>(bits_ + tables_ * bucket_bits_)),
      weights_(LocalFeatures::dimension * projections_)
{
    options.check();
    if (centre.size() != LocalFeatures::dimension)
        throw std::invalid_argument("CodeHasher: the centre has " + std::to_string(centre.size()) +
                                    " numbers, not " + std::to_string(LocalFeatures::dimension));
    std::mt19937_64 generator(seed);
    for (auto& weight : weights_) weight = static_cast<float>(standard_normal(generator));
    thresholds_ = project(centre.data(), weights_, projections_);
}

std::vector<std::uint64_t> CodeHasher::sign_bits(const float* descriptor) const
{
    const auto sums = project(descriptor, weights_, projections_);
    std::vector<std::uint64_t> words((projections_ + kWordBits - 1) / kWordBits, 0);
    for (std::size_t s = 0; s < projections_; ++s)
        if (sums[s] > thresholds_[s]) words[s / kWordBits] |= std::uint64_t{1} << (s % kWordBits);
    return words;
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

    const auto store = [&](std::size_t i)
    {
        const auto signs = sign_bits(features.descriptor(i));
        std::size_t bit = 0;
        auto* word = codes.words.data() + i * static_cast<std::size_t>(codes.words_per_code);
        for (; bit < static_cast<std::size_t>(bits_); ++bit)
            if (bit_at(signs, bit)) word[bit / kWordBits] |= std::uint64_t{1} << (bit % kWordBits);
        auto* bucket = codes.buckets.data() + i * static_cast<std::size_t>(tables_);
        for (int table = 0; table < tables_; ++table)
            for (int b = 0; b < bucket_bits_; ++b, ++bit)
                if (bit_at(signs, bit))
                    bucket[table] |= static_cast<std::uint16_t>(1U << unsigned(b));
    };
    const auto tasks = (features.size() + kFeaturesPerTask - 1) / kFeaturesPerTask;
    parallel_for(num_threads,
                 tasks,
                 [&](std::size_t task)
                 {
                     const auto end = std::min((task + 1) * kFeaturesPerTask, features.size());
                     for (std::size_t i = task * kFeaturesPerTask; i < end; ++i) store(i);
                 });
    return codes;
}

}  // namespace fild
