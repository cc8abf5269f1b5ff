// SPDX-License-Identifier: BSD-3-Clause
#include "size_change.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace fild
{
namespace
{
constexpr double kSameAspect = 1.03;
constexpr double kMaxAspect = 1.5;
constexpr double kMaxScale = 8;

/** Factor of at least 1 between two positive numbers. */
double factor_between(double a, double b)
{
    return std::max(a / b, b / a);
}

cv::Mat scaled(const cv::Mat& image, cv::Size size)
{
    const bool shrinks = size.area() < image.size().area();
    cv::Mat result;
    cv::resize(image, result, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

CameraModel moved(CameraModel camera, const SizeChange& change, const cv::Rect& kept)
{
    camera.fx *= change.scale_x;
    camera.fy *= change.scale_y;
    camera.cx = (camera.cx + 0.5) * change.scale_x - 0.5 - kept.x;
    camera.cy = (camera.cy + 0.5) * change.scale_y - 0.5 - kept.y;
    camera.width = kept.width;
    camera.height = kept.height;
    return camera;
}

void change_size(RightView& right, SizeChange change)
{
    change.scaled = {std::max(1, cvRound(change.scale_x * right.image.cols)),
                     std::max(1, cvRound(change.scale_y * right.image.rows))};
    change.scale_x = static_cast<double>(change.scaled.width) / right.image.cols;
    change.scale_y = static_cast<double>(change.scaled.height) / right.image.rows;
    right.image = scaled(right.image, change.scaled);
    right.camera = moved(right.camera, change, {{0, 0}, change.scaled});
}
}  // namespace

std::optional<SizeChange> size_change(cv::Size from, cv::Size to)
{
    if (from.empty() || to.empty()) return std::nullopt;
    SizeChange change;
    change.scale_x = static_cast<double>(to.width) / from.width;
    change.scale_y = static_cast<double>(to.height) / from.height;
    const double aspect = factor_between(change.scale_x, change.scale_y);
    const double largest = std::max(change.scale_x, change.scale_y);
    const double smallest = std::min(change.scale_x, change.scale_y);
    if (aspect > kMaxAspect || largest > kMaxScale || smallest < 1 / kMaxScale) return std::nullopt;
    change.scaled = to;
    if (aspect > kSameAspect)
        change.scaled = {cvRound(largest * from.width), cvRound(largest * from.height)};
    change.scale_x = static_cast<double>(change.scaled.width) / from.width;
    change.scale_y = static_cast<double>(change.scaled.height) / from.height;
    const auto overhang = change.scaled - to;
    change.kept = {{overhang.width / 2, overhang.height / 2}, to};
    return change;
}

CameraModel changed(const CameraModel& camera, const SizeChange& change)
{
    return moved(camera, change, change.kept);
}

void change_size(Frame& frame, const SizeChange& change)
{
    frame.image = scaled(frame.image, change.scaled)(change.kept);
    if (frame.camera) frame.camera = changed(*frame.camera, change);
    if (frame.right) change_size(*frame.right, change);
    if (frame.depth.empty()) return;
    // Between a near and a far depth lies none: they are never mixed.
    cv::Mat depth;
    cv::resize(frame.depth, depth, change.scaled, 0, 0, cv::INTER_NEAREST_EXACT);
    frame.depth = depth(change.kept);
}

std::optional<CameraModel> camera_for(const CameraModel& camera, cv::Size image, cv::Size first)
{
    const cv::Size calibrated(camera.width, camera.height);
    if (calibrated == image) return camera;
    const auto change = size_change(first, image);
    if (calibrated != first || !change || change->scaled != image) return std::nullopt;
    return changed(camera, *change);
}

}  // namespace fild
