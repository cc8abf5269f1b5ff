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

/** Larger triangles lose accuracy where they reach past the camera: Mesa's software renderer
 *  interpolates depth over the whole triangle in single precision. */
constexpr double kLargestSide_m = 2.5;

Corner mixed(const Corner& a, const Corner& b, double share_of_b)
{
    return {a.at + share_of_b * (b.at - a.at),
            a.in_picture + share_of_b * (b.in_picture - a.in_picture)};
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
    const auto cells = [](double metres)
    { return std::max(1, static_cast<int>(std::ceil(metres / kLargestSide_m))); };
    const int across = cells(cv::norm(b.at - a.at));
    const int up = cells(cv::norm(d.at - a.at));
    const auto corner = [&](int i, int j)
    {
        const auto u = static_cast<double>(i) / across;
        const auto v = static_cast<double>(j) / up;
        return mixed(mixed(a, b, u), mixed(d, c, u), v);
    };
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < up; ++j)
        {
            add_triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
            add_triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
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

bool TexturedMesh::empty() const
{
    return object_->getTrianglesCount() == 0;
}

void TexturedMesh::clear()
{
    object_->clearTriangles();
}

mrpt::opengl::CSetOfTexturedTriangles::Ptr TexturedMesh::object(const cv::Mat& picture, bool lit)
{
    object_->assignImage(mrpt::img::CImage(picture, mrpt::img::DEEP_COPY));
    object_->enableTextureLinearInterpolation(true);
    object_->enableLight(lit);
    return object_;
}

}  // namespace fild
