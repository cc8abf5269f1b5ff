// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/TTriangle.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/core/mat.hpp>

#include <array>
#include <string>
#include <vector>

namespace fild
{
/** The pose as MRPT knows it. */
mrpt::poses::CPose3D to_mrpt(const RigidTransform& b_from_a);

/** MRPT's colour of OpenCV's BGR. */
mrpt::img::TColor to_mrpt(const cv::Scalar& bgr);

mrpt::opengl::COpenGLScene::Ptr empty_scene();

/** Lines one sample of the picture wide: OpenGL's own, which MRPT 2.5 cannot make wider. */
class ThinLines
{
 public:
    explicit ThinLines(const cv::Scalar& colour);

    void add(const cv::Vec3d& from, const cv::Vec3d& to);

    /** The lines from a camera to the corners of its image plane and round it. */
    void add_frustum(const cv::Vec3d& apex, const std::array<cv::Vec3d, 4>& corners);

    mrpt::opengl::CRenderizable::Ptr make(const std::string& name) const;

 private:
    mrpt::opengl::CSetOfLines::Ptr lines_;
};

/** Lines and spots of any width, made of triangles. Unlit: they have exactly the colours they are
 *  given. */
class Strokes
{
 public:
    enum class Shape
    {
        painted,  ///< flat, as on the ground, where a line does not climb
        round
    };

    explicit Strokes(Shape shape = Shape::painted) : flatness_(shape == Shape::round ? 1 : 0.05) {}

    void add_line(const cv::Vec3d& from,
                  const cv::Vec3d& to,
                  double width,
                  const cv::Scalar& colour);

    /** A regular polygon that lies flat. \param corners  4: a square, its sides along x and y. */
    void add_spot(const cv::Vec3d& centre, double width, int corners, const cv::Scalar& colour);

    /** A triangle that lies flat. \param along  where it points; of length 1 and level. */
    void add_arrowhead(const cv::Vec3d& tip,
                       const cv::Vec3d& along,
                       double length,
                       const cv::Scalar& colour);

    mrpt::opengl::CRenderizable::Ptr make(const std::string& name) const;

 private:
    void add_triangle(const cv::Vec3d& a,
                      const cv::Vec3d& b,
                      const cv::Vec3d& c,
                      const cv::Scalar& colour);

    double flatness_;  ///< height of a level line by its width
    std::vector<mrpt::opengl::TTriangle> triangles_;
};

/** A point on the image plane of a camera at a distance, in the camera's axes.
 *  \param pixel  centres of pixels at whole coordinates. */
cv::Vec3d point_at(const CameraModel& camera, const cv::Point2d& pixel, double distance);

/** The corners of the image plane at a distance, in the map: upper left, upper right, lower right,
 *  lower left of the image. */
std::array<cv::Vec3d, 4> image_corners(const CameraModel& camera,
                                       const RigidTransform& map_from_camera,
                                       double distance);

/** Images on rectangles, seen from both sides, unlit. One texture holds all: OpenGL has few. */
class ImageWall
{
 public:
    /** \param image  8 bit, grey or BGR; all of one wall are stored in one size, the first one's
     *         shape. \param corners  of the image in the map, as image_corners() gives them. */
    void add(const cv::Mat& image, const std::array<cv::Vec3d, 4>& corners);

    bool empty() const { return images_.empty(); }

    /** \param widest_px  what an image may at most be wide in the texture; the more there are, the
     *         smaller they get. */
    mrpt::opengl::CRenderizable::Ptr make(int widest_px, const std::string& name) const;

    /** Puts images, a dozen of them if there are more, into a scene that will be stored: MRPT 2.5
     *  does not store where on a texture the corners of triangles are. Each has its own texture. */
    void insert_planes(int widest_px, mrpt::opengl::COpenGLScene& scene) const;

 private:
    std::vector<cv::Mat> images_;
    std::vector<std::array<cv::Vec3d, 4>> corners_;
};

}  // namespace fild
