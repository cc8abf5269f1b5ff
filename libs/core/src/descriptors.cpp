// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/descriptors.h"

#include "fild/core/angle.h"

#include <algorithm>
#include <cmath>

namespace fild
{
KeypointShape shape_of(const Keypoint& keypoint)
{
    const double octaves = std::log2(std::max(1.0, static_cast<double>(keypoint.size)));
    const long size = std::lround(octaves * KeypointShape::kStepsPerOctave);
    const double turns = static_cast<double>(keypoint.angle) / (360 * kRadiansPerDegree);
    const long angle = std::lround(turns * KeypointShape::kStepsPerTurn);
    return {static_cast<std::uint8_t>(std::min(255L, size)),
            static_cast<std::uint8_t>(angle & (KeypointShape::kStepsPerTurn - 1))};
}

// GCC 12 calls the thread sanitizer before it is there when it chooses a clone.
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
__attribute__((target_clones("default", "popcnt")))
#endif
int hamming_distance(const std::uint64_t* a, const std::uint64_t* b, std::size_t words)
{
    int bits = 0;
    for (std::size_t w = 0; w < words; ++w) bits += __builtin_popcountll(a[w] ^ b[w]);
    return bits;
}

}  // namespace fild
