// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/camera_model.h"

#include "fild/core/parse_number.h"
#include "fild/core/words.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
/** A number of pixels, which must be whole. */
int parse_size(double number, const std::string& origin)
{
    constexpr double kLargest = 1e6;
    if (!(number >= 1 && number <= kLargest) || number != std::floor(number))
        throw std::runtime_error(origin + ": the image size must be whole numbers of pixels");
    return static_cast<int>(number);
}
}  // namespace

CameraModel parse_camera_model(const std::string& text, const std::string& origin)
{
    const auto numbers = parse_numbers(text, origin);
    const auto count = numbers.size();
    if (count != 6 && count != 10 && count != 11)
        throw std::runtime_error(origin +
                                 ": expected 'fx fy cx cy width height [k1 k2 p1 p2 [k3]]', got " +
                                 count_of(count, "number"));
    CameraModel camera;
    camera.fx = numbers[0];
    camera.fy = numbers[1];
    camera.cx = numbers[2];
    camera.cy = numbers[3];
    camera.width = parse_size(numbers[4], origin);
    camera.height = parse_size(numbers[5], origin);
    if (!(camera.fx > 0 && camera.fy > 0))
        throw std::runtime_error(origin + ": focal lengths must be positive");
    if (count > 6) camera.lens = LensModel::plumb_bob;
    std::copy(numbers.begin() + 6, numbers.end(), camera.distortion.begin());
    return camera;
}

}  // namespace fild
