// SPDX-License-Identifier: BSD-3-Clause
// Matching of hash codes, FILD (An et al., IROS 2019), section III-C, after CasHash (Cheng et al.,
// CVPR 2014).
#include "fild/matching/code_matcher.h"

#include "fild/matching/ratio_test.h"
#include "hamming.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
constexpr int kNone = std::numeric_limits<int>::max();

/** The candidate's codes sorted by coarse bucket, one ordering for each hash table. */
class BucketTables
{
 public:
    explicit BucketTables(const BinaryCodes& codes) : codes_(codes)
    {
        for (int table = 0; table < codes.tables; ++table) sort_into_buckets(table);
    }

    /** Appends to `found`, once each, the codes that share a bucket with code `q` of `query`. */
    void collect(const BinaryCodes& query, std::size_t q, std::vector<std::uint32_t>& found)
    {
        ++round_;
        for (int table = 0; table < codes_.tables; ++table)
        {
            const auto& starts = starts_[static_cast<std::size_t>(table)];
            const auto& members = members_[static_cast<std::size_t>(table)];
            const auto bucket = query.bucket(q)[table];
            if (bucket + 1U >= starts.size()) continue;  // beyond the candidate's highest bucket
            for (auto k = starts[bucket]; k < starts[bucket + 1U]; ++k)
                if (seen_in_round_[members[k]] != round_)
                {
                    seen_in_round_[members[k]] = round_;
                    found.push_back(members[k]);
                }
        }
    }

 private:
    /** Counting sort. */
    void sort_into_buckets(int table)
    {
        std::size_t highest = 0;
        for (std::size_t i = 0; i < codes_.size(); ++i)
            highest = std::max<std::size_t>(highest, codes_.bucket(i)[table]);
        std::vector<std::uint32_t> starts(highest + 2, 0);
        for (std::size_t i = 0; i < codes_.size(); ++i) ++starts[codes_.bucket(i)[table] + 1U];
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        std::vector<std::uint32_t> members(codes_.size());
        auto next = starts;
        for (std::size_t i = 0; i < codes_.size(); ++i)
            members[next[codes_.bucket(i)[table]]++] = static_cast<std::uint32_t>(i);
        starts_.push_back(std::move(starts));
        members_.push_back(std::move(members));
    }

    const BinaryCodes& codes_;
    std::vector<std::vector<std::uint32_t>> starts_;
    std::vector<std::vector<std::uint32_t>> members_;
    std::vector<std::uint32_t> seen_in_round_ = std::vector<std::uint32_t>(codes_.size(), 0);
    std::uint32_t round_ = 0;
};

/** The two nearest candidate codes of every query code, and who is nearest to each candidate code.
 */
class NearestTwo
{
 public:
    NearestTwo(std::size_t queries, std::size_t candidates) : nearest_(queries), back_(candidates)
    {
    }

    void compare(std::size_t q, std::size_t c, int bits)
    {
        auto& nearest = nearest_[q];
        if (bits < nearest.bits)
        {
            nearest.second_bits = nearest.bits;
            nearest.bits = bits;
            nearest.index = c;
        }
        else if (bits == nearest.bits && c < nearest.index)
        {
            nearest.second_bits = bits;
            nearest.index = c;
        }
        else if (bits < nearest.second_bits)
            nearest.second_bits = bits;
        if (bits < back_[c].bits) back_[c] = {bits, q};
    }

    std::vector<Match> pass_ratio_test(double ratio, bool mutual_check) const
    {
        std::vector<Match> matches;
        for (std::size_t q = 0; q < nearest_.size(); ++q)
        {
            const auto& nearest = nearest_[q];
            if (nearest.second_bits == kNone) continue;
            if (!passes_ratio_test(nearest.bits, nearest.second_bits, ratio)) continue;
            if (mutual_check && back_[nearest.index].index != q) continue;
            matches.push_back({q, nearest.index, nearest.bits});
        }
        return matches;
    }

 private:
    struct Two
    {
        int bits = kNone;
        int second_bits = kNone;
        std::size_t index = 0;
    };
    struct One
    {
        int bits = kNone;
        std::size_t index = 0;
    };
    std::vector<Two> nearest_;  ///< of every query code
    std::vector<One> back_;  ///< of every candidate code
};

NearestTwo compare_all(const BinaryCodes& query, const BinaryCodes& candidate)
{
    NearestTwo nearest(query.size(), candidate.size());
    const auto words = static_cast<std::size_t>(query.words_per_code);
    std::vector<int> distances(candidate.size());
    for (std::size_t q = 0; q < query.size(); ++q)
    {
        hamming_distances(
            query.code(q), candidate.words.data(), words, candidate.size(), distances.data());
        for (std::size_t c = 0; c < distances.size(); ++c) nearest.compare(q, c, distances[c]);
    }
    return nearest;
}

NearestTwo compare_within_buckets(const BinaryCodes& query, const BinaryCodes& candidate)
{
    NearestTwo nearest(query.size(), candidate.size());
    const auto words = static_cast<std::size_t>(query.words_per_code);
    BucketTables tables(candidate);
    std::vector<std::uint32_t> found;
    for (std::size_t q = 0; q < query.size(); ++q)
    {
        found.clear();
        tables.collect(query, q, found);
        for (const auto c : found)
        {
            int bits = 0;
            hamming_distances(query.code(q), candidate.code(c), words, 1, &bits);
            nearest.compare(q, c, bits);
        }
    }
    return nearest;
}

void require_comparable(const BinaryCodes& query, const BinaryCodes& candidate, CodeSearch search)
{
    if (query.bits != candidate.bits || query.tables != candidate.tables)
        throw std::invalid_argument("CodeMatcher: codes of " + std::to_string(query.bits) +
                                    " and " + std::to_string(candidate.bits) +
                                    " bits, or of unlike hash tables, do not compare");
    if (search == CodeSearch::cascade && query.tables == 0)
        throw std::invalid_argument("CodeMatcher: search=cascade needs codes with hash tables");
}
}  // namespace

CodeMatcher::CodeMatcher(const THashingOptions& options)
    : search_(options.search), ratio_(options.ratio), mutual_check_(options.mutual_check)
{
    options.check();
}

std::vector<Match> CodeMatcher::match(const BinaryCodes& query, const BinaryCodes& candidate) const
{
    require_comparable(query, candidate, search_);
    const auto nearest = search_ == CodeSearch::cascade ? compare_within_buckets(query, candidate)
                                                        : compare_all(query, candidate);
    return nearest.pass_ratio_test(ratio_, mutual_check_);
}

}  // namespace fild
