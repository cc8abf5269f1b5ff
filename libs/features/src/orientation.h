// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "integral_image.h"

#include <array>
#include <cstddef>

namespace fild
{
/** Direction in which brightness grows around a keypoint, radians in [0, 2 pi), from the x axis
 *  towards the y axis; 0 where nothing changes. SURF section 4.1: Haar wavelets of side 4s in a
 * disc of radius 6s, weighted by a Gaussian of 2.5s, summed in a sliding window of pi/3. */
float dominant_orientation(const IntegralImage& integral, const Keypoint& keypoint);

/** The disc is sampled one scale apart, row by row. */
struct OrientationDisc
{
    static constexpr std::size_t radius = 6;  ///< in units of the scale
    static constexpr std::size_t half_wavelet = 2;
    static constexpr std::size_t samples = 113;
    static constexpr std::size_t padded = 128;  ///< for whole vectors

    /** How many samples a row has on either side of its middle, `distance` scales off the keypoint.
     *  */
    static constexpr std::size_t half_width(std::size_t distance)
    {
        std::size_t half = 0;
        while ((half + 1) * (half + 1) + distance * distance <= radius * radius) ++half;
        return half;
    }
};

/** The integral image at the crossings of lines one scale apart: all wavelets of the disc have
 *  their edges and middles on them. Line i is i - 8 scales right of the keypoint, or below it. */
struct DiscGrid
{
    static constexpr std::size_t lines =
        2 * (OrientationDisc::radius + OrientationDisc::half_wavelet) + 1;
    static constexpr std::size_t padded = 32;
    using Line = std::array<float, padded>;

    std::array<Line, lines> sums{};  ///< from the first crossing on
    Line inside_x{};  ///< 1 for lines in the image, 0 for others; their sums mean nothing
    Line inside_y{};
    float step = 0;  ///< pixels between lines

    static constexpr float offset(std::size_t line)
    {
        return static_cast<float>(line) - 0.5F * static_cast<float>(lines - 1);
    }
};

/** Weighted wavelet responses of the disc's samples; what follows them means nothing. */
struct DiscResponses
{
    std::array<float, OrientationDisc::padded> dx{};
    std::array<float, OrientationDisc::padded> dy{};
};

/** Radians in [0, 2 pi); 0 for (0, 0). */
float angle_of(float dx, float dy);

}  // namespace fild
