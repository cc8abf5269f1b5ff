// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** Which pairs of codes are compared. */
enum class CodeSearch
{
    cascade,  ///< those that share a coarse bucket in one of the hash tables, as CasHash does
    exhaustive,  ///< all
    guided  ///< those of keypoints that stand where the network's cells say
};

/** Section [hashing]: binary codes of local descriptors and how they are matched. */
struct THashingOptions : Options
{
    /** Signed square roots of the descriptors' numbers are hashed, each divided by its deviation,
     *  so that a few large sums do not outweigh all others (Arandjelovic & Zisserman, CVPR 2012).
     *  Not in the paper. */
    bool rooted = false;
    int bits = 256;  ///< m: bits of a code, a multiple of 32
    CodeSearch search = CodeSearch::exhaustive;
    int tables = 6;  ///< L: hash tables of the coarse step (search=cascade)
    int bucket_bits = 8;  ///< each table has 2^bucket_bits buckets (search=cascade)
    double ratio = 0.7;  ///< epsilon of the binary ratio test; distances compare with its square
    /** Keep a match only when each is the other's nearest. Not in the paper. */
    bool mutual_check = false;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
