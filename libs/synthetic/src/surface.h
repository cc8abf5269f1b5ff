// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lot.h"

#include <opencv2/core.hpp>

namespace fild
{
using Colour = cv::Vec3d;  ///< blue, green, red, 0 to 255

/** Pixels of a painted wall or street per metre. */
constexpr int kPixelsPerMetre = 40;

inline int pixels(double metres)
{
    return cvRound(metres * kPixelsPerMetre);
}

/** The rectangle in pixels of one in metres, from the top left corner of the canvas. */
inline cv::Rect pixels(const cv::Rect2d& metres)
{
    const cv::Point corner(pixels(metres.x), pixels(metres.y));
    const cv::Point end(pixels(metres.x + metres.width), pixels(metres.y + metres.height));
    return {corner, end};
}

inline cv::Scalar scalar(const Colour& colour)
{
    return {colour[0], colour[1], colour[2]};
}

/** A colour `factor` times as bright. */
inline Colour brighter(const Colour& colour, double factor)
{
    return colour * factor;
}

/** Smooth noise of deviation 1: the sum of octaves from `coarsest_px` down to 2 pixels, each half
 *  as strong as the one before. */
cv::Mat fractal_noise(const cv::Size& size, double coarsest_px, Lot& lot);

/** Multiplies the brightness of `canvas` by 1 + strength * noise. */
void shade(cv::Mat& canvas, const cv::Mat& noise, double strength);

/** Adds the grain of a rough surface, `deviation` grey values, equal in the three colours. */
void add_grain(cv::Mat& canvas, double deviation, Lot& lot);

/** A picture of one colour with smooth noise and grain. */
cv::Mat paint_mottled(const cv::Size& size, const Colour& colour, double strength, Lot& lot);

/** Fills `area` with running-bond bricks of the given size in pixels. */
void lay_bricks(cv::Mat& canvas,
                const cv::Rect& area,
                const cv::Size& brick,
                const Colour& colour,
                const Colour& mortar,
                Lot& lot);

/** Darkens or lightens `area` by `factor`. */
void tint(cv::Mat& canvas, const cv::Rect& area, double factor);

/** Blots and cracks of age: `count` stains of up to `largest_px`. */
void add_stains(cv::Mat& canvas, int count, int largest_px, Lot& lot);

}  // namespace fild
