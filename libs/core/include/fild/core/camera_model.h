// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace fild
{
/** Lens model of a CameraModel; the names are MRPT's (mrpt::img::DistortionModel). */
enum class LensModel
{
    none,  ///< pinhole
    plumb_bob,  ///< radial and tangential
    kannala_brandt  ///< fisheye
};

/** Intrinsic parameters of a camera, in pixels of an image of width x height. Value type. */
struct CameraModel
{
    double fx = 0;
    double fy = 0;
    double cx = 0;
    double cy = 0;
    int width = 0;
    int height = 0;
    LensModel lens = LensModel::none;
    /** plumb_bob: k1 k2 p1 p2 k3 k4 k5 k6 (OpenCV's order); kannala_brandt: k1 k2 k3 k4, rest 0. */
    std::array<double, 8> distortion{};
};

/** Reads "fx fy cx cy width height [k1 k2 p1 p2 [k3]]", the words of a calibration file's first
 * line (separated by blanks). With distortion words the lens is plumb_bob. \param origin  named in
 * errors: the file or the .ini key the text came from. \throw std::runtime_error on a word that is
 * no number, a wrong count of words, a focal length or a size that is not positive. */
CameraModel parse_camera_model(const std::string& text, const std::string& origin);

}  // namespace fild
