// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fild
{
/** The keypoints of a frame in square cells, to find those about a position. Refers to the
 *  features, which must outlive it. Const members may run concurrently. */
class KeypointGrid
{
 public:
    /** \param radius  of all searches, pixels. */
    KeypointGrid(const HashedFeatures& features, double radius);

    /** A keypoint that is looked for. */
    struct Wanted
    {
        PixelPosition position;
        int size = 0;  ///< KeypointShape::kStepsPerOctave-ths
        int size_tolerance = 0;
        const std::uint64_t* code = nullptr;
        int max_bits = 0;  ///< Hamming distance
    };

    /** True when a keypoint within the radius has such a size and code. */
    bool has(const Wanted& wanted) const;

 private:
    int column_of(double x) const;
    int row_of(double y) const;
    std::size_t cell_at(int column, int row) const;
    bool is_wanted(std::uint32_t keypoint, const Wanted& wanted) const;

    const HashedFeatures& features_;
    double radius_;
    int columns_;
    int rows_;
    std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace fild
