// SPDX-License-Identifier: BSD-3-Clause
// What is typical of SURF-128 descriptors, for hashing them into comparable codes.
#include "fild/features/surf.h"

#include <array>
#include <cstddef>

namespace fild
{
namespace
{
/** Of the sums of a subregion: of dx, of |dx|, of dy and of |dy|. */
struct Sums
{
    float dx;
    float abs_dx;
    float dy;
    float abs_dy;
};

/** One entry for each number of sides a subregion has on the outside of the grid: inner, edge,
 *  corner. */
using SumsOfKinds = std::array<Sums, 3>;

// Over the 39,000 descriptors of ten images (Oxford affine: graf 1 and 3, churchill 1 to 6, leuven
// A and B; default options), then over subregions of a kind and over both signs of the other
// derivative. SurfStatistics.AreThoseOfRealDescriptors repeats the measurement and prints it.
constexpr SumsOfKinds kMeans{{
    {0.0718F, 0.2083F, 0.0F, 0.0939F},
    {0.0025F, 0.0252F, 0.0F, 0.0157F},
    {0.0000F, 0.0032F, 0.0F, 0.0024F},
}};
constexpr SumsOfKinds kUndivided{{{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}};
constexpr SumsOfKinds kRootedMeans{{
    {0.0624F, 0.1888F, 0.0F, 0.1200F},
    {0.0053F, 0.0616F, 0.0F, 0.0472F},
    {0.0000F, 0.0211F, 0.0F, 0.0178F},
}};
constexpr SumsOfKinds kRootedDeviations{{
    {0.1552F, 0.0774F, 0.0948F, 0.0559F},
    {0.0574F, 0.0330F, 0.0438F, 0.0264F},
    {0.0215F, 0.0133F, 0.0180F, 0.0116F},
}};

constexpr std::size_t kSubregions = 4;

std::size_t outer_sides(std::size_t index)
{
    return index == 0 || index + 1 == kSubregions ? 1 : 0;
}

std::vector<float> over_the_grid(const SumsOfKinds& kinds)
{
    std::vector<float> numbers;
    numbers.reserve(LocalFeatures::dimension);
    for (std::size_t row = 0; row < kSubregions; ++row)
        for (std::size_t column = 0; column < kSubregions; ++column)
        {
            const auto& sums = kinds[outer_sides(row) + outer_sides(column)];
            for (const float value : {sums.dx, sums.abs_dx, sums.dx, sums.abs_dx})
                numbers.push_back(value);
            for (const float value : {sums.dy, sums.abs_dy, sums.dy, sums.abs_dy})
                numbers.push_back(value);
        }
    return numbers;
}
}  // namespace

DescriptorStatistics surf_statistics()
{
    return {over_the_grid(kMeans), over_the_grid(kUndivided)};
}

DescriptorStatistics rooted_surf_statistics()
{
    return {over_the_grid(kRootedMeans), over_the_grid(kRootedDeviations)};
}

}  // namespace fild
