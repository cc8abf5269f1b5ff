// SPDX-License-Identifier: BSD-3-Clause
// Descriptor based on sums of Haar wavelet responses, SURF-128: SURF (CVIU 2008) section 4.2.
#include "surf_descriptor.h"

#include "box_hessian.h"
#include "haar_wavelet.h"

#include <cmath>
#include <numeric>

namespace fild
{
namespace
{
/** Haar responses in the keypoint's frame. */
class OrientedHaar
{
 public:
    OrientedHaar(const IntegralImage& integral, const Keypoint& keypoint)
        : integral_(integral),
          keypoint_(keypoint),
          scale_(scale_of_mask(keypoint.size)),
          cos_(std::cos(keypoint.angle)),
          sin_(std::sin(keypoint.angle))
    {
    }

    /** \param u,v  position in the keypoint's frame, in units of its scale. */
    HaarResponse at(float u, float v) const
    {
        const auto upright = haar_response(integral_,
                                           keypoint_.x + scale_ * (u * cos_ - v * sin_),
                                           keypoint_.y + scale_ * (u * sin_ + v * cos_),
                                           scale_ * DescriptorGrid::wavelet_side);
        return {upright.dx * cos_ + upright.dy * sin_, upright.dy * cos_ - upright.dx * sin_};
    }

 private:
    const IntegralImage& integral_;
    const Keypoint& keypoint_;
    float scale_;
    float cos_;
    float sin_;
};

/** Adds one weighted response to the eight sums of its subregion. */
void accumulate(float* sums, float dx, float dy)
{
    float* along_x = sums + (dy >= 0 ? 0 : 2);
    float* along_y = sums + (dx >= 0 ? 4 : 6);
    along_x[0] += dx;
    along_x[1] += std::abs(dx);
    along_y[0] += dy;
    along_y[1] += std::abs(dy);
}
}  // namespace

SurfDescriptor surf_descriptor(const IntegralImage& integral, const Keypoint& keypoint)
{
    const OrientedHaar haar(integral, keypoint);
    const auto& grid = kDescriptorGrid;
    SurfDescriptor descriptor{};
    for (std::size_t row = 0; row < DescriptorGrid::side; ++row)
        for (std::size_t column = 0; column < DescriptorGrid::side; ++column)
        {
            const auto response = haar.at(grid.position[column], grid.position[row]);
            const float weight = grid.weight[row] * grid.weight[column];
            const auto subregion = row / DescriptorGrid::samples * DescriptorGrid::subregions +
                                   column / DescriptorGrid::samples;
            accumulate(descriptor.data() + subregion * DescriptorGrid::sums,
                       weight * response.dx,
                       weight * response.dy);
        }
    normalise(descriptor);
    return descriptor;
}

void normalise(SurfDescriptor& descriptor)
{
    std::array<double, DescriptorGrid::sums> squared{};
    for (std::size_t i = 0; i < descriptor.size(); ++i)
        squared[i % squared.size()] += static_cast<double>(descriptor[i]) * descriptor[i];
    const double total = std::accumulate(squared.begin(), squared.end(), 0.0);
    if (total == 0) return;
    const double factor = 1 / std::sqrt(total);
    for (float& value : descriptor) value = static_cast<float>(value * factor);
}

}  // namespace fild
