// SPDX-License-Identifier: BSD-3-Clause
#include "scene_objects.h"

#include "fild/core/spread.h"

#include <mrpt/opengl/CSetOfTexturedTriangles.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
mrpt::math::TPoint3Df to_point(const cv::Vec3d& p)
{
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/** How images of one size are laid out in a texture. */
struct Tiling
{
    int columns = 1;
    int rows = 1;
    cv::Size tile;
};

Tiling tile(std::size_t count, const cv::Size& image, int widest_px)
{
    constexpr int kLargestTexture = 4096;
    Tiling tiling;
    tiling.columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    tiling.rows = (static_cast<int>(count) + tiling.columns - 1) / tiling.columns;
    const int longer_side = std::max(image.width, image.height);
    const int longest = std::min({widest_px, longer_side, kLargestTexture / tiling.columns});
    const auto scaled = [&](int side) { return std::max(1, side * longest / longer_side); };
    tiling.tile = {scaled(image.width), scaled(image.height)};
    return tiling;
}

void paste(const cv::Mat& image, cv::Mat tile_of_texture)
{
    cv::Mat scaled;
    cv::resize(image, scaled, tile_of_texture.size(), 0, 0, cv::INTER_AREA);
    if (scaled.channels() == 1) cv::cvtColor(scaled, scaled, cv::COLOR_GRAY2BGR);
    scaled.copyTo(tile_of_texture);
}
}  // namespace

mrpt::poses::CPose3D to_mrpt(const RigidTransform& b_from_a)
{
    mrpt::math::CMatrixDouble33 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation(row, column) = b_from_a.rotation(row, column);
    const auto& t = b_from_a.translation;
    return {rotation, mrpt::math::CVectorFixedDouble<3>({t[0], t[1], t[2]})};
}

mrpt::img::TColor to_mrpt(const cv::Scalar& bgr)
{
    const auto byte = [&](int i) { return cv::saturate_cast<unsigned char>(bgr[i]); };
    return {byte(2), byte(1), byte(0)};
}

mrpt::opengl::COpenGLScene::Ptr empty_scene()
{
    auto scene = mrpt::opengl::COpenGLScene::Create();
    scene->getViewport()->setCustomBackgroundColor({1, 1, 1});
    return scene;
}

ThinLines::ThinLines(const cv::Scalar& colour) : lines_(mrpt::opengl::CSetOfLines::Create())
{
    lines_->setColor_u8(to_mrpt(colour));
    lines_->enableAntiAliasing(false);
}

void ThinLines::add(const cv::Vec3d& from, const cv::Vec3d& to)
{
    lines_->appendLine(from[0], from[1], from[2], to[0], to[1], to[2]);
}

void ThinLines::add_frustum(const cv::Vec3d& apex, const std::array<cv::Vec3d, 4>& corners)
{
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        add(apex, corners[i]);
        add(corners[i], corners[(i + 1) % corners.size()]);
    }
}

mrpt::opengl::CRenderizable::Ptr ThinLines::make(const std::string& name) const
{
    lines_->setName(name);
    return lines_;
}

void Strokes::add_line(const cv::Vec3d& from,
                       const cv::Vec3d& to,
                       double width,
                       const cv::Scalar& colour)
{
    const auto along = cv::normalize(to - from);
    const cv::Vec3d up(0, 0, 1);
    const auto level = along.cross(up);
    const bool climbs = cv::norm(level) < 1e-6;
    const auto side = climbs ? cv::Vec3d(1, 0, 0) : cv::normalize(level);
    auto over = side.cross(along);
    over[2] *= flatness_;
    const std::array<cv::Vec3d, 4> rim{
        side * (width / 2), over * (width / 2), side * (-width / 2), over * (-width / 2)};
    for (std::size_t i = 0; i < rim.size(); ++i)
    {
        const auto& a = rim[i];
        const auto& b = rim[(i + 1) % rim.size()];
        add_triangle(from + a, from + b, to + a, colour);
        add_triangle(to + a, from + b, to + b, colour);
    }
}

void Strokes::add_spot(const cv::Vec3d& centre, double width, int corners, const cv::Scalar& colour)
{
    const double radius = width / 2 / std::cos(CV_PI / corners);  // to the corners
    const auto corner = [&](int i)
    {
        const double angle = (2 * i + 1) * CV_PI / corners;
        return centre + cv::Vec3d(radius * std::cos(angle), radius * std::sin(angle), 0);
    };
    for (int i = 0; i < corners; ++i) add_triangle(centre, corner(i), corner(i + 1), colour);
}

void Strokes::add_arrowhead(const cv::Vec3d& tip,
                            const cv::Vec3d& along,
                            double length,
                            const cv::Scalar& colour)
{
    const cv::Vec3d aside(-along[1], along[0], 0);
    const auto back = tip - length * along;
    add_triangle(tip, back + 0.5 * length * aside, back - 0.5 * length * aside, colour);
}

mrpt::opengl::CRenderizable::Ptr Strokes::make(const std::string& name) const
{
    auto object = mrpt::opengl::CSetOfTriangles::Create();
    object->insertTriangles(triangles_.begin(), triangles_.end());
    object->setName(name);
    object->enableLight(false);
    return object;
}

void Strokes::add_triangle(const cv::Vec3d& a,
                           const cv::Vec3d& b,
                           const cv::Vec3d& c,
                           const cv::Scalar& colour)
{
    triangles_.emplace_back(to_point(a), to_point(b), to_point(c));
    triangles_.back().setColor(to_mrpt(colour));
}

cv::Vec3d point_at(const CameraModel& camera, const cv::Point2d& pixel, double distance)
{
    return {(pixel.x - camera.cx) / camera.fx * distance,
            (pixel.y - camera.cy) / camera.fy * distance,
            distance};
}

std::array<cv::Vec3d, 4> image_corners(const CameraModel& camera,
                                       const RigidTransform& map_from_camera,
                                       double distance)
{
    const double right = camera.width - 0.5;
    const double bottom = camera.height - 0.5;
    const auto corner = [&](double x, double y) {
        return map_from_camera * point_at(camera, {x, y}, distance);
    };
    return {corner(-0.5, -0.5), corner(right, -0.5), corner(right, bottom), corner(-0.5, bottom)};
}

void ImageWall::add(const cv::Mat& image, const std::array<cv::Vec3d, 4>& corners)
{
    images_.push_back(image);
    corners_.push_back(corners);
}

void ImageWall::insert_planes(int widest_px, mrpt::opengl::COpenGLScene& scene) const
{
    constexpr std::size_t kMostTextures = 12;
    for (const auto i : spread_indices(kMostTextures, images_.size()))
    {
        const auto& [upper_left, upper_right, lower_right, lower_left] = corners_[i];
        const auto half_across = (upper_right - upper_left) / 2;
        const auto half_up = (upper_left - lower_left) / 2;
        const auto right = cv::normalize(half_across);
        const auto up = cv::normalize(half_up);
        const auto towards_viewer = right.cross(up);
        RigidTransform map_from_plane;
        for (int row = 0; row < 3; ++row)
        {
            map_from_plane.rotation(row, 0) = right[row];
            map_from_plane.rotation(row, 1) = up[row];
            map_from_plane.rotation(row, 2) = towards_viewer[row];
        }
        map_from_plane.translation = (upper_left + lower_right) / 2;
        const auto x = static_cast<float>(cv::norm(half_across));
        const auto y = static_cast<float>(cv::norm(half_up));
        auto plane = mrpt::opengl::CTexturedPlane::Create(-x, x, -y, y);
        plane->setPose(to_mrpt(map_from_plane));
        cv::Mat texture(tile(1, images_[i].size(), widest_px).tile, CV_8UC3);
        paste(images_[i], texture);
        cv::flip(texture, texture, 0);  // MRPT puts its first row at the plane's least y
        plane->assignImage(mrpt::img::CImage(texture, mrpt::img::DEEP_COPY));
        plane->setName("camera image " + std::to_string(i));
        scene.insert(plane);
    }
}

mrpt::opengl::CRenderizable::Ptr ImageWall::make(int widest_px, const std::string& name) const
{
    const auto tiling = tile(images_.size(), images_.front().size(), widest_px);
    cv::Mat texture(tiling.rows * tiling.tile.height,
                    tiling.columns * tiling.tile.width,
                    CV_8UC3,
                    cv::Scalar::all(0));
    auto wall = mrpt::opengl::CSetOfTexturedTriangles::Create();
    for (std::size_t i = 0; i < images_.size(); ++i)
    {
        const int column = static_cast<int>(i) % tiling.columns;
        const int row = static_cast<int>(i) / tiling.columns;
        const cv::Rect place({column * tiling.tile.width, row * tiling.tile.height}, tiling.tile);
        paste(images_[i], texture(place));
        // Half a pixel inside, so that no neighbour shines in at the edge.
        const auto u0 = (static_cast<float>(place.x) + 0.5F) / static_cast<float>(texture.cols);
        const auto v0 = (static_cast<float>(place.y) + 0.5F) / static_cast<float>(texture.rows);
        const auto u1 =
            (static_cast<float>(place.br().x) - 0.5F) / static_cast<float>(texture.cols);
        const auto v1 =
            (static_cast<float>(place.br().y) - 0.5F) / static_cast<float>(texture.rows);
        const std::array<cv::Point2f, 4> uv{{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}};
        for (const auto& indices : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}})
        {
            mrpt::opengl::TTriangle triangle;
            for (std::size_t k = 0; k < 3; ++k)
            {
                triangle.vertex(k) = to_point(corners_[i][indices[k]]);
                triangle.u(k) = uv[indices[k]].x;
                triangle.v(k) = uv[indices[k]].y;
            }
            wall->insertTriangle(triangle);
        }
    }
    wall->setName(name);
    wall->assignImage(mrpt::img::CImage(texture, mrpt::img::DEEP_COPY));
    wall->enableLight(false);
    return wall;
}

}  // namespace fild
