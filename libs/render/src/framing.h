// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/render/picture_view.h"

#include <vector>

namespace fild
{
/** What a view must show, and where in its picture. */
struct Framing
{
    std::vector<cv::Vec3d> points;  ///< of the map, at least one
    cv::Matx33d map_from_camera;  ///< the rotation: which way the camera looks
    cv::Size size;  ///< of the picture, pixels
    cv::Rect2d inside;  ///< the part of the picture that the points may fill, pixels
    double focal_px = 1000;
    double nearest_m = 0;  ///< the camera stays at least so far from each point
};

/** Axes of a camera that looks along a heading (from the x axis to the y axis) and down by a pitch
 *  between 0 and 90 degrees, its x axis level; radians. Looking straight down, the heading is up in
 *  the picture. */
cv::Matx33d looking_down(double heading, double pitch);

/** The nearest view from which all points lie in the part of the picture, in its middle. Where
 * there is room on both sides the lens is shifted: the camera's axis need not be in the middle. */
PictureView framed_view(const Framing& framing);

}  // namespace fild
