// SPDX-License-Identifier: BSD-3-Clause
// Matching of hash codes, FILD (An et al., IROS 2019), section III-C, after CasHash (Cheng et al.,
// CVPR 2014).
#include "fild/matching/code_matcher.h"

#include "fild/matching/ratio_test.h"
#include "guided_search.h"
#include "nearest_two.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
constexpr double kUnrelatedBits = 0.45;  // share of the bits in which unrelated codes differ

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

NearestTwo nearest_of(const std::uint64_t* code,
                      const BinaryCodes& others,
                      const std::vector<std::uint32_t>& subset)
{
    const auto words = static_cast<std::size_t>(others.words_per_code);
    NearestTwo nearest;
    for (const auto i : subset) nearest.compare(i, hamming_distance(code, others.code(i), words));
    return nearest;
}

/** For each query code its two nearest among the candidate codes that the search looks at. */
std::vector<NearestTwo> nearest_candidates(const BinaryCodes& query,
                                           const BinaryCodes& candidate,
                                           CodeSearch search)
{
    std::vector<NearestTwo> nearest;
    nearest.reserve(query.size());
    if (search == CodeSearch::exhaustive)
    {
        const NearestCodes codes(candidate);
        for (std::size_t q = 0; q < query.size(); ++q)
            nearest.push_back(codes.nearest_of(query.code(q)));
        return nearest;
    }
    BucketTables tables(candidate);
    std::vector<std::uint32_t> found;
    for (std::size_t q = 0; q < query.size(); ++q)
    {
        found.clear();
        tables.collect(query, q, found);
        nearest.push_back(nearest_of(query.code(q), candidate, found));
    }
    return nearest;
}

std::size_t compared(const std::vector<NearestTwo>& codes)
{
    return static_cast<std::size_t>(std::count_if(codes.begin(),
                                                  codes.end(),
                                                  [](const NearestTwo& nearest)
                                                  { return nearest.bits != NearestTwo::kNone; }));
}

void require_comparable(const BinaryCodes& query, const BinaryCodes& candidate, CodeSearch search)
{
    if (query.bits != candidate.bits || query.tables != candidate.tables)
        throw std::invalid_argument("CodeMatcher: codes of " + std::to_string(query.bits) +
                                    " and " + std::to_string(candidate.bits) +
                                    " bits, or of unlike hash tables, do not compare");
    if (search == CodeSearch::cascade && query.tables == 0)
        throw std::invalid_argument("CodeMatcher: search=cascade needs codes with hash tables");
    if (search == CodeSearch::guided)
        throw std::invalid_argument("CodeMatcher: search=guided needs positions and cells");
}
}  // namespace

CodeMatcher::CodeMatcher(const THashingOptions& options)
    : search_(options.search), ratio_(options.ratio), mutual_check_(options.mutual_check)
{
    options.check();
}

Matching CodeMatcher::match(const HashedFeatures& query, const HashedFeatures& candidate) const
{
    if (search_ == CodeSearch::guided) return match_by_cells(query, candidate);
    return {match(query.codes, candidate.codes),
            std::min(query.codes.size(), candidate.codes.size())};
}

std::vector<Match> CodeMatcher::match(const BinaryCodes& query, const BinaryCodes& candidate) const
{
    require_comparable(query, candidate, search_);
    std::vector<Match> matches;
    const NearestCodes query_codes(query);
    const auto nearest = nearest_candidates(query, candidate, search_);
    for (std::size_t q = 0; q < nearest.size(); ++q)
    {
        const auto& [bits, second_bits, index] = nearest[q];
        if (second_bits == NearestTwo::kNone || !passes_ratio_test(bits, second_bits, ratio_))
            continue;
        if (mutual_check_ && query_codes.nearest_of(candidate.code(index)).index != q) continue;
        matches.push_back({q, index, bits});
    }
    return matches;
}

Matching CodeMatcher::match_by_cells(const HashedFeatures& query,
                                     const HashedFeatures& candidate) const
{
    require_comparable(query.codes, candidate.codes, CodeSearch::exhaustive);
    if (query.cells.codes.size() == 0 || candidate.cells.codes.size() == 0) return {};
    const auto met = meetings_by_cells(query, candidate);
    const int unrelated = static_cast<int>(kUnrelatedBits * query.codes.bits);
    Matching matching;
    for (std::size_t q = 0; q < met.of_query.size(); ++q)
    {
        const auto& [bits, second_bits, index] = met.of_query[q];
        if (bits == NearestTwo::kNone) continue;
        if (mutual_check_ && met.of_candidate[index].index != q) continue;
        if (passes_ratio_test(bits, std::min(second_bits, unrelated), ratio_))
            matching.matches.push_back({q, index, bits});
    }
    matching.compared = std::min(compared(met.of_query), compared(met.of_candidate));
    return matching;
}

}  // namespace fild
