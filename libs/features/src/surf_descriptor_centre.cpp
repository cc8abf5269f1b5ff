// SPDX-License-Identifier: BSD-3-Clause
// The common centre of SURF-128 descriptors, for hashing them into comparable codes.
#include "fild/features/surf.h"

#include <array>
#include <cstddef>

namespace fild
{
namespace
{
/** Means over a subregion's sums: of dx, of |dx| and of |dy|. That of dy is 0. */
struct SubregionMean
{
    float dx;
    float abs_dx;
    float abs_dy;
};

// Mean over the 39,000 descriptors of ten images (Oxford affine: graf 1 and 3, churchill 1 to 6,
// leuven A and B; default options), then over subregions of a kind and over both signs of the other
// derivative. SurfDescriptorCentre.IsTheMeanOfRealDescriptors repeats the measurement and prints
// it.
// One entry for each number of sides a subregion has on the outside of the grid.
constexpr std::array<SubregionMean, 3> kMeans{{
    {0.0718F, 0.2083F, 0.0939F},  // inner
    {0.0025F, 0.0252F, 0.0157F},  // edge
    {0.0000F, 0.0032F, 0.0024F},  // corner
}};

constexpr std::size_t kSubregions = 4;

std::size_t outer_sides(std::size_t index)
{
    return index == 0 || index + 1 == kSubregions ? 1 : 0;
}
}  // namespace

std::vector<float> surf_descriptor_centre()
{
    std::vector<float> centre;
    centre.reserve(LocalFeatures::dimension);
    for (std::size_t row = 0; row < kSubregions; ++row)
        for (std::size_t column = 0; column < kSubregions; ++column)
        {
            const auto& mean = kMeans[outer_sides(row) + outer_sides(column)];
            for (const float value : {mean.dx, mean.abs_dx, mean.dx, mean.abs_dx})
                centre.push_back(value);
            for (const float value : {0.0F, mean.abs_dy, 0.0F, mean.abs_dy})
                centre.push_back(value);
        }
    return centre;
}

}  // namespace fild
