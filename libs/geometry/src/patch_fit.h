// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <optional>

namespace fild
{
/** How far the patch round a pixel of the left image is moved to the left in the right image. */
struct PatchFit
{
    double disparity_px = 0;
    double deviation_px = 0;  ///< of the disparity, from what the fit leaves over
    double correlation = 0;  ///< of the patches at the end, [-1, 1]
};

/** Fits by least squares: left(x + u, y + v) = gain * right(x + u - d - a u - b v, y + v) + offset
 *  over a square of `side` pixels (odd), from disparity `start` on; a and b are the slant of the
 *  surface. \param left,right  float, smooth. \return nothing where a patch leaves its image, has
 * no texture along its rows, or the fit runs away from its start. Deterministic. */
std::optional<PatchFit> fit_patch(
    const cv::Mat& left, const cv::Mat& right, const cv::Point2d& pixel, double start, int side);

}  // namespace fild
