// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace fild::testing
{
/** A round spot with the profile of a Gaussian. */
struct Blob
{
    double x = 0;
    double y = 0;
    double sigma = 1;
    double amplitude = 0;  ///< added to the grey value at its centre; < 0: dark
};

/** p -> scale * R(angle) * p + (shift_x, shift_y). Maps blobs to blobs, so that a transformed scene
 *  is drawn without resampling. */
struct Similarity
{
    double angle = 0;
    double scale = 1;
    double shift_x = 0;
    double shift_y = 0;

    cv::Point2d operator()(double x, double y) const
    {
        const double c = scale * std::cos(angle);
        const double s = scale * std::sin(angle);
        return {c * x - s * y + shift_x, s * x + c * y + shift_y};
    }
    Blob operator()(const Blob& blob) const
    {
        const auto centre = (*this)(blob.x, blob.y);
        return {centre.x, centre.y, blob.sigma * scale, blob.amplitude};
    }
};

inline double uniform(std::mt19937_64& generator, double min, double max)
{
    return min + (max - min) * static_cast<double>(generator() >> 11) * 0x1p-53;
}

/** Grey 128 with the blobs added; grey values as the clamped, rounded sums. */
inline cv::Mat draw_blobs(cv::Size size,
                          const std::vector<Blob>& blobs,
                          const Similarity& place = {})
{
    cv::Mat_<double> sum(size, 128.0);
    for (const auto& original : blobs)
    {
        const Blob blob = place(original);
        const int reach = static_cast<int>(std::ceil(5 * blob.sigma));
        const cv::Point centre(static_cast<int>(std::lround(blob.x)),
                               static_cast<int>(std::lround(blob.y)));
        const cv::Rect window =
            cv::Rect(centre.x - reach, centre.y - reach, 2 * reach, 2 * reach) & cv::Rect({}, size);
        for (int y = window.y; y < window.y + window.height; ++y)
            for (int x = window.x; x < window.x + window.width; ++x)
            {
                const double squared = (x - blob.x) * (x - blob.x) + (y - blob.y) * (y - blob.y);
                sum(y, x) += blob.amplitude * std::exp(-squared / (2 * blob.sigma * blob.sigma));
            }
    }
    cv::Mat image;
    sum.convertTo(image, CV_8U);
    return image;
}

/** Many overlapping blobs at random in [0, width) x [0, height): a texture. */
inline std::vector<Blob> random_blobs(int count, cv::Size size, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    std::vector<Blob> blobs;
    for (int i = 0; i < count; ++i)
    {
        Blob blob;
        blob.x = uniform(generator, 0, size.width);
        blob.y = uniform(generator, 0, size.height);
        blob.sigma = uniform(generator, 1.5, 6);
        blob.amplitude = uniform(generator, -50, 50);
        blobs.push_back(blob);
    }
    return blobs;
}

/** Grey values at random, no two neighbours alike. */
inline cv::Mat noise_image(cv::Size size, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    cv::Mat_<std::uint8_t> image(size);
    for (auto& pixel : image) pixel = static_cast<std::uint8_t>(generator() >> 56);
    return image;
}

/** Brightness that grows by `slope` a pixel in direction `angle`, 128 in the middle. */
inline cv::Mat ramp_image(cv::Size size, double angle, double slope)
{
    cv::Mat_<double> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(y, x) = 128 + slope * (std::cos(angle) * (x - size.width / 2.0) +
                                         std::sin(angle) * (y - size.height / 2.0));
    cv::Mat grey;
    image.convertTo(grey, CV_8U);
    return grey;
}

/** A straight edge through the middle, one pixel soft; its normal has direction `angle`. */
inline cv::Mat edge_image(cv::Size size, double angle)
{
    cv::Mat_<double> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
        {
            const double distance = std::cos(angle) * (x - size.width / 2.0) +
                                    std::sin(angle) * (y - size.height / 2.0);
            image(y, x) = 128 + 80 * std::tanh(distance);
        }
    cv::Mat grey;
    image.convertTo(grey, CV_8U);
    return grey;
}

}  // namespace fild::testing
