// SPDX-License-Identifier: BSD-3-Clause
// Least squares matching: A. Gruen, "Adaptive least squares correlation: a powerful image matching
// technique", South African Journal of Photogrammetry 14 (1985).
#include "patch_fit.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <vector>

namespace fild
{
namespace
{
constexpr int kUnknowns = 5;  // disparity, its slopes along x and y, gain, offset
using Unknowns = cv::Vec<double, kUnknowns>;
using Normal = cv::Matx<double, kUnknowns, kUnknowns>;

/** Grey value and its slope along x between the pixels of a row and the row below. */
struct Sample
{
    double value = 0;
    double slope = 0;
};

bool contains(const cv::Mat& image, double x, double y)
{
    return x >= 1 && y >= 0 && x < image.cols - 2 && y < image.rows - 1;
}

Sample sample(const cv::Mat& image, double x, double y)
{
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const double right = x - column;
    const double down = y - row;
    const auto at = [&](int dx)
    {
        const auto upper = static_cast<double>(image.at<float>(row, column + dx));
        const auto lower = static_cast<double>(image.at<float>(row + 1, column + dx));
        return (1 - down) * upper + down * lower;
    };
    const double before = at(-1);
    const double here = at(0);
    const double next = at(1);
    const double after = at(2);
    return {(1 - right) * here + right * next,
            0.5 * ((1 - right) * (next - before) + right * (after - here))};
}

/** Sums of one pass over the patch. */
struct PassSums
{
    Normal normal = Normal::zeros();
    Unknowns gradient;
    double squares = 0;  ///< of what is left over
    double left = 0, right = 0, left_left = 0, right_right = 0, left_right = 0;

    void add(const Unknowns& row, double residual, double left_value, double right_value)
    {
        normal += row * row.t();
        gradient += residual * row;
        squares += residual * residual;
        left += left_value;
        right += right_value;
        left_left += left_value * left_value;
        right_right += right_value * right_value;
        left_right += left_value * right_value;
    }

    double correlation(int count) const
    {
        const double variances =
            (left_left - left * left / count) * (right_right - right * right / count);
        return variances > 0 ? (left_right - left * right / count) / std::sqrt(variances) : 0;
    }
};

/** A patch of the left image, and one pass of the fit. */
class Patch
{
 public:
    Patch(const cv::Mat& left, const cv::Point2d& pixel, int side) : pixel_(pixel), half_(side / 2)
    {
        values_.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        for (int v = -half_; v <= half_; ++v)
            for (int u = -half_; u <= half_; ++u)
                values_.push_back(sample(left, pixel.x + u, pixel.y + v).value);
    }

    int count() const { return static_cast<int>(values_.size()); }

    /** Nothing when the patch leaves the right image. */
    std::optional<PassSums> pass(const cv::Mat& right, const Unknowns& p) const
    {
        PassSums sums;
        auto value = values_.begin();
        for (int v = -half_; v <= half_; ++v)
            for (int u = -half_; u <= half_; ++u, ++value)
            {
                const double x = pixel_.x + u - p[0] - p[1] * u - p[2] * v;
                if (!contains(right, x, pixel_.y + v)) return std::nullopt;
                const auto seen = sample(right, x, pixel_.y + v);
                const double slope = -p[3] * seen.slope;
                const Unknowns row(slope, slope * u, slope * v, seen.value, 1);
                sums.add(row, *value - p[3] * seen.value - p[4], *value, seen.value);
            }
        return sums;
    }

    /** A step of Gauss and Newton from a shift of disparity and row on. */
    std::optional<cv::Vec2d> shift_step(const cv::Mat& right,
                                        const PatchFit& fit,
                                        const cv::Vec2d& shift) const
    {
        cv::Matx22d normal = cv::Matx22d::zeros();
        cv::Vec2d gradient(0, 0);
        auto value = values_.begin();
        for (int v = -half_; v <= half_; ++v)
            for (int u = -half_; u <= half_; ++u, ++value)
            {
                const double x =
                    pixel_.x + u - fit.disparity_px - shift[0] - fit.slant_x * u - fit.slant_y * v;
                const double y = pixel_.y + v + shift[1];
                if (!contains(right, x, y - 1) || !contains(right, x, y + 1)) return std::nullopt;
                const auto seen = sample(right, x, y);
                const double down =
                    0.5 * (sample(right, x, y + 1).value - sample(right, x, y - 1).value);
                const cv::Vec2d row(-fit.gain * seen.slope, fit.gain * down);
                normal += row * row.t();
                gradient += (*value - fit.gain * seen.value - fit.offset) * row;
            }
        bool solvable = false;
        const auto inverse = normal.inv(cv::DECOMP_CHOLESKY, &solvable);
        if (!solvable) return std::nullopt;
        return inverse * gradient;
    }

 private:
    cv::Point2d pixel_;
    int half_;
    std::vector<double> values_;
};

/** Disparity near `start`, a whole number of pixels off it, at which the patches correlate most. */
double best_of_neighbours(const Patch& patch, const cv::Mat& right, double start, int reach)
{
    double best = start;
    double best_correlation = -1;
    for (int step = -reach; step <= reach; ++step)
    {
        const auto sums = patch.pass(right, {start + step, 0, 0, 1, 0});
        if (!sums || sums->correlation(patch.count()) <= best_correlation) continue;
        best = start + step;
        best_correlation = sums->correlation(patch.count());
    }
    return best;
}
}  // namespace

std::optional<PatchFit> fit_patch(
    const cv::Mat& left, const cv::Mat& right, const cv::Point2d& pixel, double start, int side)
{
    constexpr int kReach = 3;  // pixels that keypoints of one point may differ by
    constexpr int kMaxIterations = 15;
    constexpr double kConverged = 0.005;  // pixels
    constexpr double kSteepest = 0.7;  // slope of the disparity on a surface seen at all
    const int half = side / 2;
    if (!contains(left, pixel.x - half, pixel.y - half) ||
        !contains(left, pixel.x + half, pixel.y + half))
        return std::nullopt;
    const Patch patch(left, pixel, side);
    Unknowns p(best_of_neighbours(patch, right, start, kReach), 0, 0, 1, 0);
    const double near = p[0];
    for (int i = 0; i < kMaxIterations; ++i)
    {
        const auto sums = patch.pass(right, p);
        if (!sums) return std::nullopt;
        bool solvable = false;
        const Normal inverse = sums->normal.inv(cv::DECOMP_CHOLESKY, &solvable);
        if (!solvable) return std::nullopt;
        const Unknowns step = inverse * sums->gradient;
        p += step;
        if (std::abs(p[0] - near) > 2 || std::abs(p[1]) > kSteepest || std::abs(p[2]) > kSteepest)
            return std::nullopt;
        if (std::abs(step[0]) > kConverged) continue;
        const double variance = sums->squares / (patch.count() - kUnknowns);
        return PatchFit{p[0],
                        std::sqrt(variance * inverse(0, 0)),
                        sums->correlation(patch.count()),
                        p[1],
                        p[2],
                        p[3],
                        p[4]};
    }
    return std::nullopt;
}

std::optional<double> row_shift(const cv::Mat& left,
                                const cv::Mat& right,
                                const cv::Point2d& pixel,
                                const PatchFit& fit,
                                int side)
{
    constexpr int kMaxIterations = 6;
    constexpr double kConverged = 0.01;  // pixels
    constexpr double kFarthest = 2;
    const int half = side / 2;
    if (!contains(left, pixel.x - half, pixel.y - half) ||
        !contains(left, pixel.x + half, pixel.y + half))
        return std::nullopt;
    const Patch patch(left, pixel, side);
    cv::Vec2d shift(0, 0);  // of the disparity, of the row
    for (int i = 0; i < kMaxIterations; ++i)
    {
        const auto step = patch.shift_step(right, fit, shift);
        if (!step) return std::nullopt;
        shift += *step;
        if (cv::norm(shift, cv::NORM_INF) > kFarthest) return std::nullopt;
        if (cv::norm(*step, cv::NORM_INF) < kConverged) return shift[1];
    }
    return std::nullopt;
}

}  // namespace fild
