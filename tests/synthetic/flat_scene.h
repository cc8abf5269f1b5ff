// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/render/offscreen_renderer.h"

#include <mrpt/poses/CPose3D.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <vector>

namespace fild::testing
{
/** A rectangle in space: centre, and half its extent as two vectors at right angles. */
struct Panel
{
    cv::Point3d centre;
    cv::Point3d half_width;
    cv::Point3d half_height;
};

/** A wall across x: `width` along y, from z = 0 to `height`. */
inline Panel wall_across_x(double x, double y, double width, double height)
{
    return {{x, y, height / 2}, {0, width / 2, 0}, {0, 0, height / 2}};
}

inline cv::Point3d to_point(const mrpt::math::TPoint3D& p)
{
    return {p.x, p.y, p.z};
}

/** Draws panels without OpenGL, a ray for each pixel; each panel has a pattern of squares, so that
 *  the images differ from place to place. */
inline RenderedView draw_panels(const std::vector<Panel>& panels,
                                const CameraModel& camera,
                                const mrpt::poses::CPose3D& map_from_camera)
{
    RenderedView view{cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar(230, 200, 180)),
                      cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(0))};
    const auto eye = to_point(map_from_camera.translation());
    for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u)
        {
            const auto ray = to_point(map_from_camera.rotateVector(
                {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1}));
            auto& depth = view.depth.at<float>(v, u);
            for (const auto& panel : panels)
            {
                const auto normal = panel.half_width.cross(panel.half_height);
                const double z = (panel.centre - eye).dot(normal) / ray.dot(normal);
                if (!(z > 0) || (depth > 0 && z >= static_cast<double>(depth))) continue;
                const auto on_panel = eye + z * ray - panel.centre;
                const double a =
                    on_panel.dot(panel.half_width) / panel.half_width.dot(panel.half_width);
                const double b =
                    on_panel.dot(panel.half_height) / panel.half_height.dot(panel.half_height);
                if (std::abs(a) > 1 || std::abs(b) > 1) continue;
                depth = static_cast<float>(z);
                const int squares = static_cast<int>(std::floor(a * 7) + std::floor(b * 5));
                view.image.at<cv::Vec3b>(v, u) =
                    cv::Vec3b::all(static_cast<uchar>(squares % 2 == 0 ? 60 : 160));
            }
        }
    return view;
}

}  // namespace fild::testing
