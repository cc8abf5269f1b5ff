// SPDX-License-Identifier: BSD-3-Clause
#include "keypoint_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace fild
{
KeypointGrid::KeypointGrid(const HashedFeatures& features, double radius)
    : features_(features),
      radius_(std::max(1.0, radius)),
      columns_(static_cast<int>(features.image_size.width / radius_) + 1),
      rows_(static_cast<int>(features.image_size.height / radius_) + 1),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_))
{
    for (std::size_t k = 0; k < features.positions.size(); ++k)
    {
        const auto& p = features.positions[k];
        const int column = column_of(static_cast<double>(p.x));
        const int row = row_of(static_cast<double>(p.y));
        cells_[cell_at(column, row)].push_back(static_cast<std::uint32_t>(k));
    }
}

int KeypointGrid::column_of(double x) const
{
    return std::clamp(static_cast<int>(x / radius_), 0, columns_ - 1);
}

int KeypointGrid::row_of(double y) const
{
    return std::clamp(static_cast<int>(y / radius_), 0, rows_ - 1);
}

std::size_t KeypointGrid::cell_at(int column, int row) const
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
}

bool KeypointGrid::is_wanted(std::uint32_t keypoint, const Wanted& wanted) const
{
    const auto& p = features_.positions[keypoint];
    if (std::abs(int{features_.shapes[keypoint].size} - wanted.size) > wanted.size_tolerance)
        return false;
    if (std::hypot(p.x - wanted.position.x, p.y - wanted.position.y) > radius_) return false;
    const auto words = static_cast<std::size_t>(features_.codes.words_per_code);
    return hamming_distance(wanted.code, features_.codes.code(keypoint), words) <= wanted.max_bits;
}

bool KeypointGrid::has(const Wanted& wanted) const
{
    const int column = column_of(static_cast<double>(wanted.position.x));
    const int row = row_of(static_cast<double>(wanted.position.y));
    for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
            for (const auto k : cells_[cell_at(x, y)])
                if (is_wanted(k, wanted)) return true;
    return false;
}

}  // namespace fild
