// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_labels.h"

#include "number_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fild
{
namespace
{
std::size_t parse_frame(const NumberRow& row, std::size_t column)
{
    const double value = row.values[column];
    if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max()) ||
        value != std::floor(value))
        throw std::runtime_error(row.origin + ": " + std::to_string(value) +
                                 " is no frame number; they are whole numbers from 0");
    return static_cast<std::size_t>(value);
}
}  // namespace

std::size_t LoopLabels::unanswerable_queries() const
{
    return static_cast<std::size_t>(std::count_if(earlier_frames.begin(),
                                                  earlier_frames.end(),
                                                  [](const auto& query)
                                                  { return query.second.empty(); }));
}

LoopLabels to_loop_labels(std::vector<std::pair<std::size_t, std::size_t>> pairs,
                          std::optional<std::size_t> frames)
{
    LoopLabels labels;
    labels.frames = frames;
    const auto above = std::count_if(
        pairs.begin(), pairs.end(), [](const auto& pair) { return pair.second > pair.first; });
    const auto below = std::count_if(
        pairs.begin(), pairs.end(), [](const auto& pair) { return pair.second < pair.first; });
    labels.transposed = above > below;
    if (labels.transposed)
        for (auto& pair : pairs) std::swap(pair.first, pair.second);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [query, candidate] : pairs)
    {
        if (candidate < query)
        {
            labels.earlier_frames[query].push_back(candidate);
            ++labels.pairs;
        }
        else if (candidate == query)
            ++labels.on_diagonal;
        else if (std::binary_search(pairs.begin(), pairs.end(), std::pair(candidate, query)))
            ++labels.mirrored;
        else
        {
            labels.earlier_frames[query];  // remains a loop query
            ++labels.dropped;
        }
    }
    return labels;
}

LoopLabels read_loop_list(const std::string& path)
{
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::set<std::pair<std::size_t, std::size_t>> doubtful;
    for (const auto& row : read_number_rows(path))
    {
        const bool is_doubtful = row.values.size() == 3 && row.values[2] == 0;
        if (!is_doubtful) require_numbers(row, 2, "QUERY CANDIDATE, frame numbers from 0");
        const std::pair pair(parse_frame(row, 0), parse_frame(row, 1));
        if (is_doubtful)
            doubtful.insert(pair);
        else
            pairs.push_back(pair);
    }
    auto labels = to_loop_labels(std::move(pairs), std::nullopt);
    for (const auto& [query, candidate] : doubtful)
        labels.doubtful.emplace(std::max(query, candidate), std::min(query, candidate));
    return labels;
}

}  // namespace fild
