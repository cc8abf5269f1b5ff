// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/CSetOfTexturedTriangles.h>
#include <opencv2/core.hpp>

#include <array>

namespace fild
{
/** A corner of a surface: where it is, and where in the picture, which spans [0, 1] x [0, 1] from
 *  its top left corner and repeats beyond. */
struct Corner
{
    cv::Point3d at;
    cv::Point2d in_picture;
};

/** Surfaces that share one picture. */
class TexturedMesh
{
 public:
    TexturedMesh() : object_(mrpt::opengl::CSetOfTexturedTriangles::Create()) {}

    /** Corners counter-clockwise as seen from the side that is seen. */
    void add_triangle(const Corner& a, const Corner& b, const Corner& c);
    /** The same for a rectangle, in small triangles; a, b, c, d go around. */
    void add_quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d);
    /** A quad that shows `part` of the picture upright: corners bottom left, bottom right, top
     *  right, top left. */
    void add_panel(const std::array<cv::Point3d, 4>& corners, const cv::Rect2d& part);
    /** A triangle of a rounded surface, lit by the normals of its corners. */
    void add_smooth_triangle(const std::array<Corner, 3>& corners,
                             const std::array<cv::Point3d, 3>& normals);

    bool empty() const;
    /** Takes all surfaces away; an object() made before shows those that are added later. */
    void clear();

    /** The surfaces as an object of a scene. \param lit  by the sun; else as bright as painted. */
    mrpt::opengl::CSetOfTexturedTriangles::Ptr object(const cv::Mat& picture, bool lit = true);

 private:
    mrpt::opengl::CSetOfTexturedTriangles::Ptr object_;
};

}  // namespace fild
