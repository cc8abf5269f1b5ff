// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/matching/hashing_options.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fild
{
/** Turns local descriptors into binary codes by random projections, the locality sensitive hash
 *  family of FILD (IROS 2019) Eq. (5): bit s of a descriptor x is 1 when
 *  p_s . (x - mean) / deviation > 0, with p_s of independent normal numbers. With options.rooted, x
 *  is the signed square root of the descriptor, brought to unit norm.
 *
 *  Mean and deviation are the same for all images; the authors' published code subtracts each
 *  image's own mean, after which codes of different images do not compare. Const members may run
 *  concurrently. */
class CodeHasher
{
 public:
    /** \param typical  of the descriptors, rooted ones with options.rooted.
     *  \param seed     of the projections: the same seed gives the same codes everywhere.
     *  \throw std::invalid_argument on statistics of another length. */
    CodeHasher(const THashingOptions& options,
               const DescriptorStatistics& typical,
               std::uint64_t seed);

    /** Codes of all features, and their coarse buckets when options.search is cascade.
     *  Costs features x dimension x bits multiplications, spread over `num_threads` threads. */
    BinaryCodes hash(const LocalFeatures& features, int num_threads) const;

 private:
    /** Sets the feature's bits, which are zero, from its projections. */
    void store(const float* projections, std::size_t feature, BinaryCodes& codes) const;

    bool rooted_;
    int bits_;
    int tables_;  ///< 0 without the coarse step
    int bucket_bits_;
    std::size_t projections_;  ///< bits_ + tables_ x bucket_bits_
    std::vector<float> weights_;  ///< p_s / deviation, side by side in panels of a few
    std::vector<float> thresholds_;  ///< the mean's projections, as many as the panels have
};

}  // namespace fild
