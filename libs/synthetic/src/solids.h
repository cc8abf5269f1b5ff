// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_frame.h"
#include "textured_mesh.h"

#include <vector>

namespace fild
{
/** An upright prism of `sides` sides around a point. */
void add_post(TexturedMesh& mesh,
              const PlaceFrame& frame,
              const cv::Point2d& centre,
              const cv::Vec2d& bottom_and_top,
              double radius,
              int sides);

/** An ellipse in space. `ahead` x `left` points from one ring of a tube to the next. */
struct Ring
{
    cv::Point3d centre;
    cv::Point3d ahead;  ///< half axis
    cv::Point3d left;  ///< half axis
};

/** A rounded tube through rings. It shows `part` of the picture, from its lower edge (first ring)
 *  to its upper edge (last ring); the middle of the part is ahead. */
void add_tube(TexturedMesh& mesh, const std::vector<Ring>& rings, const cv::Rect2d& part);

/** A point of a limb, and how thick it is there. */
struct LimbPoint
{
    cv::Point3d at;
    double radius = 0;
};

/** A tube of round cross-sections along a line. */
void add_limb(TexturedMesh& mesh, const std::vector<LimbPoint>& points, const cv::Rect2d& part);

}  // namespace fild
