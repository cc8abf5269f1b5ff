// SPDX-License-Identifier: BSD-3-Clause
#include "textured_mesh.h"

#include <cmath>

namespace fild
{
namespace
{
mrpt::math::TPoint3Df mrpt_point(const cv::Point3d& point)
{
    return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
}

cv::Point3d unit(const cv::Point3d& vector)
{
    return vector / std::max(cv::norm(vector), 1e-9);
}
}  // namespace

void TexturedMesh::add_smooth_triangle(const std::array<Corner, 3>& corners,
                                       const std::array<cv::Point3d, 3>& normals)
{
    mrpt::opengl::TTriangle triangle(mrpt_point(corners[0].at),
                                     mrpt_point(corners[1].at),
                                     mrpt_point(corners[2].at),
                                     mrpt_point(unit(normals[0])),
                                     mrpt_point(unit(normals[1])),
                                     mrpt_point(unit(normals[2])));
    for (std::size_t i = 0; i < 3; ++i)
    {
        triangle.u(i) = static_cast<float>(corners[i].in_picture.x);
        triangle.v(i) = static_cast<float>(corners[i].in_picture.y);
    }
    object_->insertTriangle(triangle);
}

void TexturedMesh::add_triangle(const Corner& a, const Corner& b, const Corner& c)
{
    const auto normal = (b.at - a.at).cross(c.at - a.at);
    add_smooth_triangle({a, b, c}, {normal, normal, normal});
}

void TexturedMesh::add_quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d)
{
    add_triangle(a, b, c);
    add_triangle(a, c, d);
}

void TexturedMesh::add_panel(const std::array<cv::Point3d, 4>& corners, const cv::Rect2d& part)
{
    const auto left = part.x;
    const auto right = part.x + part.width;
    const auto top = part.y;
    const auto bottom = part.y + part.height;
    add_quad({corners[0], {left, bottom}},
             {corners[1], {right, bottom}},
             {corners[2], {right, top}},
             {corners[3], {left, top}});
}

mrpt::opengl::CSetOfTexturedTriangles::Ptr TexturedMesh::object(const cv::Mat& picture, bool lit)
{
    object_->assignImage(mrpt::img::CImage(picture, mrpt::img::DEEP_COPY));
    object_->enableTextureLinearInterpolation(true);
    object_->enableLight(lit);
    return object_;
}

}  // namespace fild
