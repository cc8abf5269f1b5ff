// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"

#include <opencv2/core/mat.hpp>

#include <memory>
#include <string>

namespace mrpt::opengl
{
class CFBORender;
class COpenGLScene;
}  // namespace mrpt::opengl
namespace mrpt::poses
{
class CPose3D;
}

namespace fild
{
/** What a camera sees of a scene. Value type. */
struct RenderedView
{
    cv::Mat image;  ///< 8 bit BGR
    cv::Mat depth;  ///< float, metres along the optical axis; 0 where nothing is drawn (sky)
};

/** How far away things must be to be drawn, metres along the optical axis. The error of a depth z
 * is bounded by z^2 / (near_m * 2^24). Value type. */
struct ClipRange
{
    double near_m = 0.5;
    double far_m = 1000;
};

/** Draws an MRPT scene into memory through OSMesa: needs no screen, no GPU and no window library.
 *
 *  Every pixel is the mean of 2x2 samples, and textures are filtered by mipmaps, so that what is
 *  far away does not flicker from view to view. All renderers of a thread share one OpenGL context.
 *  Deterministic: the same scene, camera and pose give the same bytes on the same machine.
 *
 *  Bound to the thread that made it; the scene must not be drawn by anything else and belongs to
 *  this class as long as it lives. */
class OffscreenRenderer
{
 public:
    /** \throw std::runtime_error when no OpenGL context can be made, or when the gl functions of
     *         this program are not those of libOSMesa. */
    explicit OffscreenRenderer(std::shared_ptr<mrpt::opengl::COpenGLScene> scene,
                               const ClipRange& clip = {});
    ~OffscreenRenderer();
    OffscreenRenderer(const OffscreenRenderer&) = delete;
    OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

    /** \param camera  pinhole; pixel centres are at whole coordinates, as in OpenCV.
     *  \param map_from_camera  x right, y down, z forward.
     *  \throw std::invalid_argument when the camera has a lens distortion or no size. */
    RenderedView draw(const CameraModel& camera, const mrpt::poses::CPose3D& map_from_camera);

    /** As draw(), the picture alone: costs half. */
    cv::Mat draw_image(const CameraModel& camera, const mrpt::poses::CPose3D& map_from_camera);

    /** File of the library whose gl functions this program calls. */
    static std::string gl_library();

 private:
    class Context;
    struct Canvases;

    mrpt::opengl::CFBORender& canvas_for(const CameraModel& camera,
                                         const mrpt::poses::CPose3D& map_from_camera);

    std::shared_ptr<Context> context_;
    std::unique_ptr<Canvases> canvases_;
    std::shared_ptr<mrpt::opengl::COpenGLScene> scene_;
};

}  // namespace fild
