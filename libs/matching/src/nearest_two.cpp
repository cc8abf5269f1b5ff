// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_two.h"

#include "processor_clones.h"

#include <algorithm>
#include <array>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace fild
{
namespace
{
constexpr std::size_t kLanes = 8;

/** For a number of words known to the compiler, which then unrolls the loop; 0: not known. */
template <std::size_t kWords>
[[gnu::always_inline]] inline void distances_of(const std::uint64_t* code,
                                                const std::uint64_t* others,
                                                std::size_t words,
                                                std::vector<int>& distances)
{
    const std::size_t length = kWords == 0 ? words : kWords;
    for (auto& distance : distances)
    {
        int bits = 0;
        for (std::size_t w = 0; w < length; ++w) bits += __builtin_popcountll(code[w] ^ others[w]);
        distance = bits;
        others += length;
    }
}

#ifdef __x86_64__
/** A distance and the index of its code in one number, which sorts by distance, then by index. */
constexpr std::uint64_t kNoKey = std::numeric_limits<std::int64_t>::max();

NearestTwo two_least(const std::array<std::uint64_t, 2 * kLanes>& keys)
{
    NearestTwo nearest;
    for (const auto key : keys)
        if (key != kNoKey) nearest.compare(key & 0xFFFFFFFFU, static_cast<int>(key >> 32U));
    return nearest;
}

/** Each lane keeps the two least keys of the codes that it has seen. */
__attribute__((target("avx512f,avx512vpopcntdq"))) NearestTwo nearest_in_blocks(
    const std::uint64_t* code, std::size_t words, const std::uint64_t* blocks, std::size_t count)
{
    auto best = _mm512_set1_epi64(static_cast<long long>(kNoKey));
    auto second = best;
    auto index = _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7);
    for (std::size_t first = 0; first < count; first += kLanes)
    {
        auto bits = _mm512_setzero_si512();
        for (std::size_t w = 0; w < words; ++w, blocks += kLanes)
        {
            const auto word = _mm512_set1_epi64(static_cast<long long>(code[w]));
            const auto differing = _mm512_xor_si512(word, _mm512_loadu_si512(blocks));
            bits = _mm512_add_epi64(bits, _mm512_popcnt_epi64(differing));
        }
        const auto key = _mm512_or_si512(bits << 32, index);
        const auto there =
            static_cast<__mmask8>(0xFFU >> (kLanes - std::min(kLanes, count - first)));
        const auto farther = _mm512_mask_max_epu64(best, there, best, key);
        second = _mm512_mask_min_epu64(second, there, second, farther);
        best = _mm512_mask_min_epu64(best, there, best, key);
        index = _mm512_add_epi64(index, _mm512_set1_epi64(kLanes));
    }
    std::array<std::uint64_t, 2 * kLanes> keys{};
    _mm512_storeu_si512(keys.data(), best);
    _mm512_storeu_si512(keys.data() + kLanes, second);
    return two_least(keys);
}
#endif

/** Eight codes after the other, with their first words side by side, then their second words... The
 *  last block is filled up with zeros. */
std::vector<std::uint64_t> to_blocks(const BinaryCodes& codes, std::size_t words)
{
    const auto count = (codes.size() + kLanes - 1) / kLanes;
    std::vector<std::uint64_t> blocks(count * kLanes * words, 0);
    for (std::size_t i = 0; i < codes.size(); ++i)
        for (std::size_t w = 0; w < words; ++w)
            blocks[(i / kLanes * words + w) * kLanes + i % kLanes] = codes.code(i)[w];
    return blocks;
}
}  // namespace

FILD_CLONED_FOR("popcnt")
void hamming_distances(const std::uint64_t* code,
                       const BinaryCodes& others,
                       std::vector<int>& distances)
{
    const auto words = static_cast<std::size_t>(others.words_per_code);
    distances.resize(others.size());
    if (words == 4)  // 256 bits, what nearly everybody uses
        distances_of<4>(code, others.words.data(), words, distances);
    else
        distances_of<0>(code, others.words.data(), words, distances);
}

bool NearestCodes::can_compare_eight()
{
#ifdef __x86_64__
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vpopcntdq");
#else
    return false;
#endif
}

NearestCodes::NearestCodes(const BinaryCodes& codes) : NearestCodes(codes, can_compare_eight()) {}

NearestCodes::NearestCodes(const BinaryCodes& codes, bool eight_at_a_time)
    : codes_(codes), words_(static_cast<std::size_t>(codes.words_per_code))
{
    if (eight_at_a_time) blocks_ = to_blocks(codes, words_);
}

NearestTwo NearestCodes::nearest_of(const std::uint64_t* code) const
{
#ifdef __x86_64__
    if (!blocks_.empty()) return nearest_in_blocks(code, words_, blocks_.data(), codes_.size());
#endif
    std::vector<int> distances;
    hamming_distances(code, codes_, distances);
    NearestTwo nearest;
    for (std::size_t i = 0; i < distances.size(); ++i) nearest.compare(i, distances[i]);
    return nearest;
}

}  // namespace fild
