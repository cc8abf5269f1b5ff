// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/stereo_depths.h"

#include "pair_motion.h"
#include "patch_fit.h"
#include "rectified_pair.h"
#include "row_matches.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace fild
{
namespace
{
void require_pair(const Frame& frame, const HashedFeatures& left, const HashedFeatures& right)
{
    if (!frame.camera || !frame.right)
        throw std::invalid_argument("depths_from_stereo: the frame has no calibrated pair");
    const auto fits = [](const CameraModel& camera, const cv::Mat& image)
    { return cv::Size(camera.width, camera.height) == image.size() && !image.empty(); };
    if (!fits(*frame.camera, frame.image) || !fits(frame.right->camera, frame.right->image))
        throw std::invalid_argument("depths_from_stereo: a camera is for another image size");
    if (left.codes.bits != right.codes.bits && left.codes.size() > 0 && right.codes.size() > 0)
        throw std::invalid_argument("depths_from_stereo: codes of " +
                                    std::to_string(left.codes.bits) + " and " +
                                    std::to_string(right.codes.bits) + " bits do not compare");
}

/** Between pixels the images are taken to be linear, which blurred ones are more nearly. */
cv::Mat smooth(const cv::Mat& image)
{
    constexpr double kSigma = 0.8;  // pixels
    cv::Mat blurred;
    cv::GaussianBlur(image, blurred, {}, kSigma);
    return blurred;
}

/** Depth in the left camera of a rectified pixel at a disparity. */
double depth_of(const RectifiedPair& pair, const cv::Point2d& pixel, double disparity)
{
    const double z = pair.focal_px * pair.baseline_m / disparity;
    const cv::Vec3d ray((pixel.x - pair.principal_point.x) / pair.focal_px,
                        (pixel.y - pair.principal_point.y) / pair.focal_px,
                        1);
    return z * (pair.camera_from_rectified * ray)[2];
}

/** A rectified pair, and its keypoints matched on its rows. */
struct MatchedRows
{
    RectifiedPair pair;
    std::vector<cv::Point2d> left;  ///< keypoints in the rectified left image
    std::vector<cv::Point2d> right;
    std::vector<Match> matches;
};

MatchedRows matched_at(const Frame& frame,
                       const RigidTransform& left_from_right,
                       const HashedFeatures& left,
                       const HashedFeatures& right,
                       const TDepthOptions& options)
{
    MatchedRows rows;
    rows.pair = rectified_pair(frame, left_from_right);
    rows.left = transformed(left.positions, rows.pair.left_pixel_from_raw);
    rows.right = transformed(right.positions, rows.pair.right_pixel_from_raw);
    const RowSearch search{options.max_row_error_px,
                           rows.pair.focal_px * rows.pair.baseline_m / options.min_depth_m,
                           options.stereo_ratio};
    rows.matches = match_on_rows(rows.left, left.codes, rows.right, right.codes, search);
    return rows;
}

/** Compares the patches about matched keypoints. */
class MatchedPatches
{
 public:
    MatchedPatches(const MatchedRows& rows, const TDepthOptions& options)
        : rows_(rows),
          left_(smooth(rows.pair.left)),
          right_(smooth(rows.pair.right)),
          side_(options.patch_px),
          min_correlation_(options.min_correlation)
    {
    }

    /** Nothing where the patches do not correlate. */
    std::optional<PatchFit> fit(const Match& match) const
    {
        const auto& pixel = rows_.left[match.query];
        const double start = pixel.x - rows_.right[match.candidate].x;
        const auto fitted = fit_patch(left_, right_, pixel, start, side_);
        if (!fitted || fitted->correlation < min_correlation_) return std::nullopt;
        return fitted;
    }

    std::optional<double> shift_of_row(const Match& match, const PatchFit& fitted) const
    {
        return row_shift(left_, right_, rows_.left[match.query], fitted, side_);
    }

 private:
    const MatchedRows& rows_;
    cv::Mat left_;
    cv::Mat right_;
    int side_;
    double min_correlation_;
};

/** As pose_of_moved_right(), by patches rather than keypoints: these are some tenths of a pixel
 *  off. */
RigidTransform pose_by_patches(const Frame& frame,
                               const MatchedRows& rows,
                               const HashedFeatures& left,
                               const TDepthOptions& options)
{
    constexpr double kPixel = 0.1;
    const MatchedPatches patches(rows, options);
    std::vector<PixelPosition> left_pixels;
    std::vector<PixelPosition> right_pixels;
    std::vector<Match> fitted;
    for (const auto& match : rows.matches)
    {
        const auto fit = patches.fit(match);
        if (!fit) continue;
        const auto shift = patches.shift_of_row(match, *fit);
        if (!shift) continue;
        const auto& pixel = rows.left[match.query];
        left_pixels.push_back(left.positions[match.query]);
        right_pixels.push_back({static_cast<float>(pixel.x - fit->disparity_px),
                                static_cast<float>(pixel.y + *shift)});
        fitted.push_back({fitted.size(), fitted.size(), 0});
    }
    const auto raw = transformed(right_pixels, rows.pair.right_pixel_from_raw.inv());
    for (std::size_t i = 0; i < raw.size(); ++i)
        right_pixels[i] = {static_cast<float>(raw[i].x), static_cast<float>(raw[i].y)};
    return pose_of_moved_right(frame, left_pixels, right_pixels, fitted, kPixel);
}

/** Rectified, and matched on its rows, as the cameras were when they took the images. */
MatchedRows matched_pair(const Frame& frame,
                         const HashedFeatures& left,
                         const HashedFeatures& right,
                         const TDepthOptions& options)
{
    constexpr double kPixel = 0.4;  // of keypoints
    auto matched = matched_at(frame, frame.right->left_from_right, left, right, options);
    if (frame.right->seconds_later == 0) return matched;
    const auto moved =
        pose_of_moved_right(frame, left.positions, right.positions, matched.matches, kPixel);
    if (!is_usable_baseline(moved)) return matched;
    matched = matched_at(frame, moved, left, right, options);
    const auto refined = pose_by_patches(frame, matched, left, options);
    return is_usable_baseline(refined) ? matched_at(frame, refined, left, right, options) : matched;
}
}  // namespace

KeypointDepths depths_from_stereo(const Frame& frame,
                                  const HashedFeatures& left,
                                  const HashedFeatures& right,
                                  const TDepthOptions& options)
{
    options.check();
    require_pair(frame, left, right);
    if (!is_usable_baseline(frame.right->left_from_right)) return {};
    constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();
    KeypointDepths depths;
    depths.source = DepthSource::stereo;
    depths.metres.assign(left.positions.size(), kNoDepth);
    depths.deviations_m.assign(left.positions.size(), kNoDepth);

    const auto matched = matched_pair(frame, left, right, options);
    const MatchedPatches patches(matched, options);
    for (const auto& match : matched.matches)
    {
        const auto fit = patches.fit(match);
        if (!fit) continue;
        const double relative_deviation =
            std::hypot(options.disparity_deviation_px, fit->deviation_px) / fit->disparity_px;
        const double z = depth_of(matched.pair, matched.left[match.query], fit->disparity_px);
        if (!(fit->disparity_px > 0) || !(relative_deviation <= options.max_relative_deviation) ||
            !(z >= options.min_depth_m))
            continue;
        depths.metres[match.query] = static_cast<float>(z);
        depths.deviations_m[match.query] = static_cast<float>(relative_deviation * z);
    }
    return depths;
}

}  // namespace fild
