// SPDX-License-Identifier: BSD-3-Clause
#include "calibration_mismatch.h"

#include "size_change.h"
#include "undistorter.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace fild
{
namespace
{
std::string number_text(double number)
{
    constexpr int kDigits = 8;
    std::array<char, 32> text{};
    const auto end = std::to_chars(
        text.data(), text.data() + text.size(), number, std::chars_format::general, kDigits);
    return {text.data(), end.ptr};
}

bool is_central(const CameraModel& camera, cv::Size size)
{
    constexpr double kNear = 0.2;  // of the size
    return !size.empty() && std::abs(camera.cx / size.width - 0.5) < kNear &&
           std::abs(camera.cy / size.height - 0.5) < kNear;
}

/** True when camera_parameters can say all of it: at most k1 k2 p1 p2 k3. */
bool fits_in_parameters(const CameraModel& camera)
{
    constexpr std::ptrdiff_t kSayable = 5;
    return camera.lens != LensModel::kannala_brandt &&
           std::all_of(camera.distortion.begin() + kSayable,
                       camera.distortion.end(),
                       [](double coefficient) { return coefficient == 0; });
}

std::string setting_of(const CameraModel& camera)
{
    std::string text = "[input] camera_parameters =";
    for (const double number : {camera.fx, camera.fy, camera.cx, camera.cy})
        text += " " + number_text(number);
    text += " " + std::to_string(camera.width) + " " + std::to_string(camera.height);
    if (has_distortion(camera))
        for (std::size_t i = 0; i < 5; ++i) text += " " + number_text(camera.distortion.at(i));
    return text;
}
}  // namespace

std::string to_text(cv::Size size)
{
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string mending_advice(const CameraModel& camera, cv::Size images)
{
    const cv::Size calibrated(camera.width, camera.height);
    const auto change = size_change(calibrated, images);
    if (fits_in_parameters(camera) && is_central(camera, images))
    {
        auto mended = camera;
        mended.width = images.width;
        mended.height = images.height;
        return "if only the size is wrong, set " + setting_of(mended);
    }
    if (fits_in_parameters(camera) && is_central(camera, calibrated) && change &&
        change->scaled == images)
        return std::string("if the images were made ") +
               (images.area() < calibrated.area() ? "smaller" : "larger") + ", set " +
               setting_of(changed(camera, *change));
    return "calibrate it for that size";
}

}  // namespace fild
