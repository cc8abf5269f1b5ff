// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/cell_agreement.h"

#include "nearest_two.h"

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
constexpr int kAgreeingNeighbours = 2;

/** The pairs (i of a, j of b) of codes each of which is the other's nearest; of equally near ones the
 *  lowest index counts. */
std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(const BinaryCodes& a,
                                                                const BinaryCodes& b)
{
    const NearestCodes codes_a(a);
    const NearestCodes codes_b(b);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const auto j = codes_b.nearest_of(a.code(i)).index;
        if (codes_a.nearest_of(b.code(j)).index == i) pairs.emplace_back(i, j);
    }
    return pairs;
}

struct Shift
{
    int rows;
    int columns;
};

/** Where each cell of the query has moved to; the cells row by row, with an empty one all around. */
class Shifts
{
 public:
    Shifts(const CellCodes& query, const CellCodes& candidate)
        : width_(static_cast<std::size_t>(query.columns) + 2),
          shifts_(width_ * (static_cast<std::size_t>(query.rows) + 2))
    {
        for (const auto& [q, c] : mutual_nearest(query.codes, candidate.codes))
        {
            const auto [row, column] = cell_of(q, query.columns);
            const auto [other_row, other_column] = cell_of(c, candidate.columns);
            shifts_[index_of(row, column)] = Shift{other_row - row, other_column - column};
        }
    }

    bool agrees_with_neighbours(int row, int column) const
    {
        const auto& shift = shifts_[index_of(row, column)];
        if (!shift) return false;
        int agreeing = -1;  // it agrees with itself
        for (int i = row - 1; i <= row + 1; ++i)
            for (int j = column - 1; j <= column + 1; ++j)
                if (is_alike(*shift, shifts_[index_of(i, j)])) ++agreeing;
        return agreeing >= kAgreeingNeighbours;
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

    static bool is_alike(const Shift& a, const std::optional<Shift>& b)
    {
        return b && std::abs(a.rows - b->rows) <= 1 && std::abs(a.columns - b->columns) <= 1;
    }

    std::size_t width_;
    std::vector<std::optional<Shift>> shifts_;
};
}  // namespace

std::size_t agreeing_cells(const CellCodes& query, const CellCodes& candidate)
{
    if (query.codes.size() == 0 || candidate.codes.size() == 0) return 0;
    if (query.codes.bits != candidate.codes.bits)
        throw std::invalid_argument("agreeing_cells: codes of " + std::to_string(query.codes.bits) +
                                    " and " + std::to_string(candidate.codes.bits) +
                                    " bits do not compare");
    const Shifts shifts(query, candidate);
    std::size_t agreeing = 0;
    for (int row = 0; row < query.rows; ++row)
        for (int column = 0; column < query.columns; ++column)
            if (shifts.agrees_with_neighbours(row, column)) ++agreeing;
    return agreeing;
}

}  // namespace fild
