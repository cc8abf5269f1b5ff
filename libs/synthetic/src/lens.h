// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/render/offscreen_renderer.h"

#include <opencv2/core/mat.hpp>

#include <functional>

namespace fild
{
/** Makes what a lens shows out of what a pinhole sees. Const members may run concurrently. */
class Lens
{
 public:
    /** \param camera  with plumb_bob distortion, or none. */
    explicit Lens(const CameraModel& camera);

    /** The picture that the lens gives; its depth is that of a pinhole with the camera's focal
     *  length and size.
     *  \param draw  what a pinhole sees. */
    RenderedView view(const std::function<RenderedView(const CameraModel&)>& draw) const;

 private:
    CameraModel pinhole_;  ///< as large as all that the lens shows
    cv::Rect camera_area_;  ///< of the pinhole, what it shows without the lens
    cv::Mat map_x_;  ///< empty: no distortion
    cv::Mat map_y_;
};

}  // namespace fild
