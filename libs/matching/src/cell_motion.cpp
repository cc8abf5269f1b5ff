// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/cell_motion.h"

#include "nearest_two.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
constexpr int kAgreeingNeighbours = 2;

/** The pairs (i of a, j of b) of codes each of which is the other's nearest; of equally near ones
 *  the lowest index counts. */
std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(const BinaryCodes& a,
                                                                const BinaryCodes& b)
{
    std::vector<NearestTwo> nearest_of_a(a.size());
    std::vector<NearestTwo> nearest_of_b(b.size());
    std::vector<int> distances;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        hamming_distances(a.code(i), b, distances);
        for (std::size_t j = 0; j < b.size(); ++j)
        {
            nearest_of_a[i].compare(j, distances[j]);
            nearest_of_b[j].compare(i, distances[j]);
        }
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (const auto j = nearest_of_a[i].index; nearest_of_b[j].index == i)
            pairs.emplace_back(i, j);
    return pairs;
}

/** Where each matched cell of the query has moved to; the cells row by row, with an empty one all
 *  around. */
class MatchedCells
{
 public:
    MatchedCells(const CellCodes& query, const CellCodes& candidate)
        : width_(static_cast<std::size_t>(query.columns) + 2),
          shifts_(width_ * (static_cast<std::size_t>(query.rows) + 2))
    {
        for (const auto& [q, c] : mutual_nearest(query.codes, candidate.codes))
        {
            const auto [row, column] = cell_of(q, query.columns);
            const auto [other_row, other_column] = cell_of(c, candidate.columns);
            shifts_[index_of(row, column)] = CellShift{other_row - row, other_column - column};
        }
    }

    /** Empty when the cell is not matched, or too few of those about it have moved as it has. */
    std::optional<CellShift> agreed_shift(int row, int column) const
    {
        const auto& shift = shifts_[index_of(row, column)];
        if (!shift) return std::nullopt;
        int agreeing = -1;  // it agrees with itself
        for (int i = row - 1; i <= row + 1; ++i)
            for (int j = column - 1; j <= column + 1; ++j)
                if (is_alike(*shift, shifts_[index_of(i, j)])) ++agreeing;
        return agreeing >= kAgreeingNeighbours ? shift : std::nullopt;
    }

 private:
    static std::pair<int, int> cell_of(std::size_t i, int columns)
    {
        return {static_cast<int>(i) / columns, static_cast<int>(i) % columns};
    }

    std::size_t index_of(int row, int column) const
    {
        return static_cast<std::size_t>(row + 1) * width_ + static_cast<std::size_t>(column + 1);
    }

    static bool is_alike(const CellShift& a, const std::optional<CellShift>& b)
    {
        return b && std::abs(a.rows - b->rows) <= 1 && std::abs(a.columns - b->columns) <= 1;
    }

    std::size_t width_;
    std::vector<std::optional<CellShift>> shifts_;
};
}  // namespace

std::size_t CellMotion::agreeing() const
{
    return static_cast<std::size_t>(std::count_if(
        shifts.begin(), shifts.end(), [](const auto& shift) { return shift.has_value(); }));
}

CellMotion cell_motion(const CellCodes& query, const CellCodes& candidate)
{
    if (query.codes.size() == 0 || candidate.codes.size() == 0) return {};
    if (query.codes.bits != candidate.codes.bits)
        throw std::invalid_argument("cell_motion: codes of " + std::to_string(query.codes.bits) +
                                    " and " + std::to_string(candidate.codes.bits) +
                                    " bits do not compare");
    const MatchedCells matched(query, candidate);
    CellMotion motion{query.rows, query.columns, {}};
    motion.shifts.reserve(query.codes.size());
    for (int row = 0; row < query.rows; ++row)
        for (int column = 0; column < query.columns; ++column)
            motion.shifts.push_back(matched.agreed_shift(row, column));
    return motion;
}

}  // namespace fild
