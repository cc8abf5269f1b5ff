// SPDX-License-Identifier: BSD-3-Clause
// Descriptor based on sums of Haar wavelet responses, SURF-128: SURF (CVIU 2008) section 4.2.
#include "surf_descriptor.h"

#include "box_hessian.h"
#include "haar_wavelet.h"

#include <cmath>

namespace fild
{
namespace
{
constexpr std::size_t kSubregions = 4;  // a side of the square
constexpr std::size_t kSamples = 5;  // a side of a subregion
constexpr std::size_t kSumsPerSubregion = 8;
constexpr float kWaveletSide = 2.0F;  // all lengths in units of the scale s
constexpr float kSigma = 3.3F;
constexpr float kMiddle = 0.5F * (kSubregions * kSamples - 1);

static_assert(kSubregions * kSubregions * kSumsPerSubregion == LocalFeatures::dimension);

/** exp(-d^2 / 2 sigma^2) of the 20 sample positions along one axis. */
std::array<float, kSubregions * kSamples> gaussian_weights()
{
    std::array<float, kSubregions * kSamples> weights{};
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        const float distance = static_cast<float>(i) - kMiddle;
        weights[i] = std::exp(distance * distance / (-2 * kSigma * kSigma));
    }
    return weights;
}

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
                                           scale_ * kWaveletSide);
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

void normalise(SurfDescriptor& descriptor)
{
    double squared = 0;
    for (const float value : descriptor) squared += static_cast<double>(value) * value;
    if (squared == 0) return;
    const double factor = 1 / std::sqrt(squared);
    for (float& value : descriptor) value = static_cast<float>(value * factor);
}
}  // namespace

SurfDescriptor surf_descriptor(const IntegralImage& integral, const Keypoint& keypoint)
{
    const OrientedHaar haar(integral, keypoint);
    const auto weights = gaussian_weights();
    SurfDescriptor descriptor{};
    for (std::size_t row = 0; row < weights.size(); ++row)
        for (std::size_t column = 0; column < weights.size(); ++column)
        {
            const auto response =
                haar.at(static_cast<float>(column) - kMiddle, static_cast<float>(row) - kMiddle);
            const float weight = weights[row] * weights[column];
            const auto subregion = row / kSamples * kSubregions + column / kSamples;
            accumulate(descriptor.data() + subregion * kSumsPerSubregion,
                       weight * response.dx,
                       weight * response.dy);
        }
    normalise(descriptor);
    return descriptor;
}

}  // namespace fild
