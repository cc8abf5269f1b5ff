// SPDX-License-Identifier: BSD-3-Clause
// Rectification as in A. Fusiello, E. Trucco, A. Verri, "A compact algorithm for rectification of
// stereo pairs", Machine Vision and Applications 12 (2000).
#include "rectified_pair.h"

#include "pinhole.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
cv::Mat to_grey_float(const cv::Mat& image)
{
    cv::Mat grey = image;
    if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::Mat values;
    grey.convertTo(values, CV_32F);
    return values;
}

/** Rotation into axes with x along the baseline and z between both optical axes. */
cv::Matx33d rectified_from_left(const RigidTransform& left_from_right)
{
    const auto x = cv::normalize(left_from_right.translation);
    const cv::Vec3d between(left_from_right.rotation(0, 2),
                            left_from_right.rotation(1, 2),
                            left_from_right.rotation(2, 2) + 1);
    const auto y = cv::normalize(between.cross(x));
    const auto z = x.cross(y);
    return {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

/** The smallest upright rectangle that holds an image after a homography; no larger than twice the
 *  image, should the cameras squint. */
cv::Rect2d bounds_after(const cv::Matx33d& homography, cv::Size size)
{
    const auto right = static_cast<float>(size.width - 1);
    const auto bottom = static_cast<float>(size.height - 1);
    const auto corners =
        transformed({{0, 0}, {right, 0}, {0, bottom}, {right, bottom}}, homography);
    const auto [left_most, right_most] = std::minmax_element(
        corners.begin(), corners.end(), [](auto& a, auto& b) { return a.x < b.x; });
    const auto [top_most, bottom_most] = std::minmax_element(
        corners.begin(), corners.end(), [](auto& a, auto& b) { return a.y < b.y; });
    const double longest = 2.0 * std::max(size.width, size.height);
    return {left_most->x,
            top_most->y,
            std::min(right_most->x - left_most->x, longest),
            std::min(bottom_most->y - top_most->y, longest)};
}

cv::Mat warped(const cv::Mat& image, const cv::Matx33d& homography, cv::Size size)
{
    constexpr double kSame = 1e-9;
    const auto change = homography * (1 / homography(2, 2)) - cv::Matx33d::eye();
    if (image.size() == size && cv::norm(change, cv::NORM_INF) < kSame) return image;
    cv::Mat result;
    cv::warpPerspective(image, result, homography, size, cv::INTER_LINEAR);
    return result;
}
}  // namespace

std::vector<cv::Point2d> transformed(const std::vector<PixelPosition>& pixels,
                                     const cv::Matx33d& homography)
{
    std::vector<cv::Point2d> result;
    result.reserve(pixels.size());
    for (const auto& pixel : pixels)
    {
        const auto p =
            homography * cv::Vec3d(static_cast<double>(pixel.x), static_cast<double>(pixel.y), 1);
        result.emplace_back(p[0] / p[2], p[1] / p[2]);
    }
    return result;
}

RectifiedPair rectified_pair(const Frame& frame, const RigidTransform& left_from_right)
{
    const auto rotation = rectified_from_left(left_from_right);
    RectifiedPair pair;
    pair.focal_px = std::sqrt(frame.camera->fx * frame.camera->fy);
    pair.baseline_m = cv::norm(left_from_right.translation);
    pair.camera_from_rectified = rotation.t();
    const auto raw_left = camera_matrix(*frame.camera);
    const auto raw_right = camera_matrix(frame.right->camera);

    const double f = pair.focal_px;
    const cv::Matx33d centred(f, 0, frame.camera->cx, 0, f, frame.camera->cy, 0, 0, 1);
    const auto bounds = bounds_after(centred * rotation * raw_left.inv(), frame.image.size());
    pair.principal_point = {frame.camera->cx - bounds.x, frame.camera->cy - bounds.y};
    const cv::Size size(static_cast<int>(std::ceil(bounds.width - 1e-6)) + 1,
                        static_cast<int>(std::ceil(bounds.height - 1e-6)) + 1);
    const cv::Matx33d camera(f, 0, pair.principal_point.x, 0, f, pair.principal_point.y, 0, 0, 1);
    pair.left_pixel_from_raw = camera * rotation * raw_left.inv();
    pair.right_pixel_from_raw = camera * rotation * left_from_right.rotation * raw_right.inv();
    pair.left = warped(to_grey_float(frame.image), pair.left_pixel_from_raw, size);
    pair.right = warped(to_grey_float(frame.right->image), pair.right_pixel_from_raw, size);
    return pair;
}

}  // namespace fild
