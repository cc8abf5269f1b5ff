// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "gaussian.h"
#include "integral_image.h"

#include <array>

namespace fild
{
using SurfDescriptor = std::array<float, LocalFeatures::dimension>;

/** The extended SURF descriptor, SURF section 4.2: a square of side 20s in the keypoint's
 * direction, 4x4 subregions of 5x5 Haar wavelets of side 2s, weighted by a Gaussian of 3.3s. Order
 * of the numbers as in SurfExtractor::extract. \return of unit norm, or all 0 where nothing
 * changes. */
SurfDescriptor surf_descriptor(const IntegralImage& integral, const Keypoint& keypoint);

/** Where the square is sampled, along either axis and in units of the scale. */
struct DescriptorGrid
{
    static constexpr std::size_t subregions = 4;  ///< a side of the square
    static constexpr std::size_t samples = 5;  ///< a side of a subregion
    static constexpr std::size_t sums = 8;  ///< of a subregion
    static constexpr std::size_t side = subregions * samples;
    static constexpr float wavelet_side = 2;

    std::array<float, side> position{};  ///< from the keypoint
    std::array<float, side> weight{};

    constexpr DescriptorGrid()
    {
        constexpr double kSigma = 3.3;
        for (std::size_t i = 0; i < side; ++i)
        {
            position[i] = static_cast<float>(i) - 0.5F * static_cast<float>(side - 1);
            weight[i] = gaussian(static_cast<double>(position[i]), kSigma);
        }
    }
};
inline constexpr DescriptorGrid kDescriptorGrid;
static_assert(DescriptorGrid::subregions * DescriptorGrid::subregions * DescriptorGrid::sums ==
              LocalFeatures::dimension);

/** Brings a descriptor to unit norm, unless it is all 0. */
void normalise(SurfDescriptor& descriptor);

}  // namespace fild
