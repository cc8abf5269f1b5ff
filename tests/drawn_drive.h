// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/random.h"

#include <opencv2/imgproc.hpp>

#include <random>
#include <vector>

namespace fild::testing
{
/** A wall of discs and bars of all sizes and shades, the same for the same seed. */
inline cv::Mat draw_wall(int width, int height, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    const auto below = [&](int bound)
    { return static_cast<int>(generator() % static_cast<std::uint64_t>(bound)); };
    cv::Mat wall(height, width, CV_8UC1, cv::Scalar(128));
    for (int i = 0; i < width * height / 400; ++i)
    {
        const cv::Point centre(below(width), below(height));
        const cv::Scalar shade(below(256));
        if (i % 2 == 0)
            cv::circle(wall, centre, 2 + below(10), shade, cv::FILLED, cv::LINE_AA);
        else
            cv::rectangle(
                wall, {centre.x, centre.y, 4 + below(16), 3 + below(8)}, shade, cv::FILLED);
    }
    return wall;
}

/** A camera that drives along a wall `frames` steps, and then once more from the start, a little
 *  further to the side: frame frames + i shows what frame i shows. */
inline std::vector<cv::Mat> draw_two_laps(std::size_t frames, cv::Size size = {320, 240})
{
    constexpr int kStep = 80;
    const int count = static_cast<int>(frames);
    const auto wall = draw_wall(kStep * count + size.width + 40, size.height + 20, 1);
    std::vector<cv::Mat> images;
    for (int lap = 0; lap < 2; ++lap)
        for (int i = 0; i < count; ++i)
            images.push_back(
                wall(cv::Rect(kStep * i + 7 * lap, 4 * lap, size.width, size.height)).clone());
    return images;
}

}  // namespace fild::testing
