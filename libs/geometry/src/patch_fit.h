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
    double slant_x = 0;  ///< a and b of fit_patch()
    double slant_y = 0;
    double gain = 1;
    double offset = 0;
};

/** Fits by least squares: left(x + u, y + v) = gain * right(x + u - d - a u - b v, y + v) + offset
 *  over a square of `side` pixels (odd), from disparity `start` on; a and b are the slant of the
 *  surface. \param left,right  float, smooth. \return nothing where a patch leaves its image, has
 * no texture along its rows, or the fit runs away from its start. Deterministic. */
std::optional<PatchFit> fit_patch(
    const cv::Mat& left, const cv::Mat& right, const cv::Point2d& pixel, double start, int side);

/** How far below its row the patch is in the right image, pixels, where that is up to two: by least
 *  squares, together with a change of the disparity. \return nothing where a patch leaves its
 *  image, has no texture in both directions, or the fit runs away. Deterministic. */
std::optional<double> row_shift(const cv::Mat& left,
                                const cv::Mat& right,
                                const cv::Point2d& pixel,
                                const PatchFit& fit,
                                int side);

}  // namespace fild
