// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_hessian.h"
#include "surf_descriptor.h"
#include "wide_haar.h"

#include <cmath>

namespace fild
{
/** The grid with one lane for each subregion, row by row: entry i of a lane is sample i of the
 *  subregion's row or column. */
struct SubregionLanes
{
    static constexpr std::size_t count = DescriptorGrid::subregions * DescriptorGrid::subregions;
    using OfSamples = std::array<std::array<float, count>, DescriptorGrid::samples>;

    OfSamples u{};
    OfSamples v{};
    OfSamples column_weight{};
    OfSamples row_weight{};

    constexpr SubregionLanes()
    {
        for (std::size_t i = 0; i < DescriptorGrid::samples; ++i)
            for (std::size_t lane = 0; lane < count; ++lane)
            {
                const auto column = lane % DescriptorGrid::subregions * DescriptorGrid::samples + i;
                const auto row = lane / DescriptorGrid::subregions * DescriptorGrid::samples + i;
                u[i][lane] = kDescriptorGrid.position[column];
                v[i][lane] = kDescriptorGrid.position[row];
                column_weight[i][lane] = kDescriptorGrid.weight[column];
                row_weight[i][lane] = kDescriptorGrid.weight[row];
            }
    }
};
inline constexpr SubregionLanes kSubregionLanes;

/** Computes the sums of kCount subregions side by side. */
template <int kCount>
class WideSubregions
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;

 public:
    FILD_IN_LANES WideSubregions(const IntegralImage& integral, const Keypoint& keypoint)
        : wavelets_(integral, scale_of_mask(keypoint.size) * DescriptorGrid::wavelet_side),
          keypoint_(keypoint),
          scale_(scale_of_mask(keypoint.size)),
          cos_(std::cos(keypoint.angle)),
          sin_(std::sin(keypoint.angle))
    {
    }

    /** Stores the sums of subregions first, first + 1... at their places in the descriptor. */
    FILD_IN_LANES void sum_up(std::size_t first, SurfDescriptor& descriptor) const
    {
        Floats sums[DescriptorGrid::sums] = {};
        for (std::size_t row = 0; row < DescriptorGrid::samples; ++row)
            for (std::size_t column = 0; column < DescriptorGrid::samples; ++column)
                add_sample(first, row, column, sums);

        float numbers[DescriptorGrid::sums][kCount];
        std::memcpy(numbers, sums, sizeof(numbers));
        for (std::size_t lane = 0; lane < kCount; ++lane)
            for (std::size_t k = 0; k < DescriptorGrid::sums; ++k)
                descriptor[(first + lane) * DescriptorGrid::sums + k] = numbers[k][lane];
    }

 private:
    FILD_IN_LANES void add_sample(std::size_t first,
                                  std::size_t row,
                                  std::size_t column,
                                  Floats* sums) const
    {
        const Floats zero{};
        const auto u = L::template load<Floats>(&kSubregionLanes.u[column][first]);
        const auto v = L::template load<Floats>(&kSubregionLanes.v[row][first]);
        const Floats weight =
            L::template load<Floats>(&kSubregionLanes.row_weight[row][first]) *
            L::template load<Floats>(&kSubregionLanes.column_weight[column][first]);
        const auto upright = wavelets_.at(keypoint_.x + scale_ * (u * cos_ - v * sin_),
                                          keypoint_.y + scale_ * (u * sin_ + v * cos_));
        const Floats dx = weight * (upright.dx * cos_ + upright.dy * sin_);
        const Floats dy = weight * (upright.dy * cos_ - upright.dx * sin_);
        sums[0] += dy >= zero ? dx : zero;
        sums[1] += dy >= zero ? L::magnitude(dx) : zero;
        sums[2] += dy >= zero ? zero : dx;
        sums[3] += dy >= zero ? zero : L::magnitude(dx);
        sums[4] += dx >= zero ? dy : zero;
        sums[5] += dx >= zero ? L::magnitude(dy) : zero;
        sums[6] += dx >= zero ? zero : dy;
        sums[7] += dx >= zero ? zero : L::magnitude(dy);
    }

    WideHaar<kCount> wavelets_;
    const Keypoint& keypoint_;
    float scale_;
    float cos_;
    float sin_;
};

/** surf_descriptor(), surf_descriptor.h, of kCount subregions at a time. */
template <int kCount>
FILD_IN_LANES SurfDescriptor surf_descriptor_in_lanes(const IntegralImage& integral,
                                                      const Keypoint& keypoint)
{
    if (!WideHaar<kCount>::can_read(integral)) return surf_descriptor(integral, keypoint);
    const WideSubregions<kCount> subregions(integral, keypoint);
    SurfDescriptor descriptor;
    for (std::size_t first = 0; first < SubregionLanes::count; first += kCount)
        subregions.sum_up(first, descriptor);
    normalise(descriptor);
    return descriptor;
}

}  // namespace fild
