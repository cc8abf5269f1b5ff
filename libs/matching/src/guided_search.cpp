// SPDX-License-Identifier: BSD-3-Clause
#include "guided_search.h"

#include "fild/matching/cell_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fild
{
namespace
{
constexpr int kReach = 3;  // cells, of those that tell where a cell has moved to
constexpr double kRadius = 1.75;  // cells, about where the centre of a cell has moved to

/** A position in cells: (0.5, 0.5) is the centre of the first. */
struct CellPosition
{
    double x;
    double y;
};

std::vector<CellPosition> in_cells(const HashedFeatures& features)
{
    const double columns = features.cells.columns / static_cast<double>(features.image_size.width);
    const double rows = features.cells.rows / static_cast<double>(features.image_size.height);
    std::vector<CellPosition> positions;
    positions.reserve(features.positions.size());
    for (const auto& p : features.positions)
        positions.push_back(
            {(static_cast<double>(p.x) + 0.5) * columns, (static_cast<double>(p.y) + 0.5) * rows});
    return positions;
}

std::size_t index_of_cell(int row, int column, int columns)
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
}

/** Keypoints by the cell that they are in. */
class KeypointsOfCells
{
 public:
    explicit KeypointsOfCells(const HashedFeatures& features)
        : positions_(in_cells(features)),
          rows_(features.cells.rows),
          columns_(features.cells.columns),
          members_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_))
    {
        for (std::size_t i = 0; i < positions_.size(); ++i)
            members_[index_of(row_of(positions_[i].y), column_of(positions_[i].x))].push_back(i);
    }

    const std::vector<std::size_t>& in(int row, int column) const
    {
        return members_[index_of(row, column)];
    }

    /** The keypoints within kRadius of the place. */
    std::vector<std::size_t> about(const CellPosition& place) const
    {
        std::vector<std::size_t> found;
        for (int row = row_of(place.y - kRadius); row <= row_of(place.y + kRadius); ++row)
            for (int column = column_of(place.x - kRadius); column <= column_of(place.x + kRadius);
                 ++column)
                for (const auto i : in(row, column))
                    if (is_about(place, positions_[i])) found.push_back(i);
        return found;
    }

 private:
    static bool is_about(const CellPosition& a, const CellPosition& b)
    {
        return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) <= kRadius * kRadius;
    }

    int row_of(double y) const { return std::clamp(static_cast<int>(std::floor(y)), 0, rows_ - 1); }

    int column_of(double x) const
    {
        return std::clamp(static_cast<int>(std::floor(x)), 0, columns_ - 1);
    }

    std::size_t index_of(int row, int column) const { return index_of_cell(row, column, columns_); }

    std::vector<CellPosition> positions_;
    int rows_;
    int columns_;
    std::vector<std::vector<std::size_t>> members_;
};

/** The mean shift of the cells about one that have one, nearer ones counting more. */
std::optional<CellPosition> mean_shift(const CellMotion& motion, int row, int column)
{
    CellPosition sum{0, 0};
    double weights = 0;
    for (int i = std::max(0, row - kReach); i <= std::min(motion.rows - 1, row + kReach); ++i)
        for (int j = std::max(0, column - kReach);
             j <= std::min(motion.columns - 1, column + kReach);
             ++j)
        {
            const auto& shift = motion.shifts[index_of_cell(i, j, motion.columns)];
            const int squared = (i - row) * (i - row) + (j - column) * (j - column);
            if (!shift || squared > kReach * kReach) continue;
            const double weight = std::exp(-0.5 * squared);
            sum.x += weight * shift->columns;
            sum.y += weight * shift->rows;
            weights += weight;
        }
    if (weights == 0) return std::nullopt;
    return CellPosition{sum.x / weights, sum.y / weights};
}

BinaryCodes chosen(const BinaryCodes& codes, const std::vector<std::size_t>& which)
{
    const auto length = static_cast<std::size_t>(codes.words_per_code);
    BinaryCodes result;
    result.bits = codes.bits;
    result.words_per_code = codes.words_per_code;
    result.words.reserve(which.size() * length);
    for (const auto i : which)
        result.words.insert(result.words.end(), codes.code(i), codes.code(i) + length);
    return result;
}
}  // namespace

Meetings meetings_by_cells(const HashedFeatures& query, const HashedFeatures& candidate)
{
    const auto motion = cell_motion(query.cells, candidate.cells);
    const KeypointsOfCells here(query);
    const KeypointsOfCells there(candidate);
    Meetings met{std::vector<NearestTwo>(query.codes.size()),
                 std::vector<NearestTwo>(candidate.codes.size())};
    std::vector<int> distances;
    for (int row = 0; row < motion.rows; ++row)
        for (int column = 0; column < motion.columns; ++column)
        {
            const auto shift = mean_shift(motion, row, column);
            if (!shift || here.in(row, column).empty()) continue;
            const auto near = there.about({column + 0.5 + shift->x, row + 0.5 + shift->y});
            const auto codes = chosen(candidate.codes, near);
            for (const auto q : here.in(row, column))
            {
                hamming_distances(query.codes.code(q), codes, distances);
                for (std::size_t k = 0; k < near.size(); ++k)
                {
                    met.of_query[q].compare(near[k], distances[k]);
                    met.of_candidate[near[k]].compare(q, distances[k]);
                }
            }
        }
    return met;
}

}  // namespace fild
