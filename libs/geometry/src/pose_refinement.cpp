// SPDX-License-Identifier: BSD-3-Clause
#include "pose_refinement.h"

#include "fild/core/upper_median.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fild
{
namespace
{
// Quantiles of the chi-squared distribution with 1, 2 and 3 degrees of freedom.
constexpr double kMedian1 = 0.4549;
constexpr double kMedian2 = 1.3863;
constexpr double kTail2 = 13.816;
constexpr double kTail3 = 16.266;
constexpr double kUnknowns = 6;  // of a pose
constexpr double kCauchy = 2.385;  // 95 % efficient on Gaussian noise

cv::Matx33d covariance_of(const PoseResidual& residual, const MeasuredNoise& noise)
{
    return noise.pixel_deviation_px * noise.pixel_deviation_px * residual.pixel_part +
           noise.depth_factor * noise.depth_factor * residual.depth_part;
}

double squared_mahalanobis(const PoseResidual& residual, const cv::Matx33d& information)
{
    return residual.value.dot(information * residual.value);
}

/** Noise of keypoints has long tails, so that its median says little about the largest errors of
 *  true matches: these never fall short of what is usual. */
MeasuredNoise at_least_usual(const MeasuredNoise& noise)
{
    constexpr double kUsualPx = 0.5;
    return {std::max(noise.pixel_deviation_px, kUsualPx), std::max(noise.depth_factor, 1.0)};
}

bool agrees(const PoseResidual& residual, const MeasuredNoise& noise)
{
    const cv::Matx33d information = covariance_of(residual, noise).inv();
    return squared_mahalanobis(residual, information) <
           (residual.has_depth_equation ? kTail3 : kTail2);
}

/** The deviation at which the median of `normalised(deviation)`, which falls, is as expected. */
template <class Normalised>
double deviation_at_median(const Normalised& normalised, double expected, double low, double high)
{
    constexpr int kHalvings = 30;
    for (int i = 0; i < kHalvings; ++i)
    {
        const double middle = std::sqrt(low * high);
        (upper_median(normalised(middle)) > expected ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

using Residuals = std::vector<PoseResidual>;

/** Noise of pixels from the two equations in pixels. */
double measured_pixel_deviation(const Residuals& residuals, const MeasuredNoise& noise)
{
    const auto normalised = [&](double deviation)
    {
        std::vector<double> values;
        values.reserve(residuals.size());
        for (const auto& residual : residuals)
        {
            const auto s = covariance_of(residual, {deviation, noise.depth_factor});
            const cv::Matx22d pixels(s(0, 0), s(0, 1), s(1, 0), s(1, 1));
            const cv::Vec2d value(residual.value[0], residual.value[1]);
            values.push_back(value.dot(pixels.inv() * value));
        }
        return values;
    };
    return deviation_at_median(normalised, kMedian2, 0.02, 20);
}

/** Noise of depths from the third equation, where enough matches have it; else 1. */
double measured_depth_factor(const Residuals& residuals, const MeasuredNoise& noise)
{
    constexpr std::size_t kEnough = 20;
    const auto normalised = [&](double factor)
    {
        std::vector<double> values;
        for (const auto& residual : residuals)
            if (residual.has_depth_equation)
                values.push_back(residual.value[2] * residual.value[2] /
                                 covariance_of(residual, {noise.pixel_deviation_px, factor})(2, 2));
        return values;
    };
    return normalised(1).size() < kEnough ? 1 : deviation_at_median(normalised, kMedian1, 0.3, 10);
}

/** Of matches that all agree with the pose. */
Residuals residuals_of(const std::vector<MeasuredMatch>& matches,
                       const PinholePair& cameras,
                       const RigidTransform& pose,
                       const std::vector<std::size_t>& which)
{
    Residuals residuals;
    residuals.reserve(which.size());
    for (const auto k : which)
        residuals.push_back(pose_residual(matches[k], cameras, pose).value());
    return residuals;
}

/** Normal equations of weighted least squares. */
struct NormalEquations
{
    cv::Matx66d information = cv::Matx66d::zeros();
    cv::Vec<double, 6> gradient;
};

/** Cauchy's loss at a residual. */
struct RobustWeight
{
    cv::Matx33d information;  ///< inverse covariance times the weight
    double weight = 1;
    double slope = 1;  ///< of the residual's pull, mean over directions; less than the weight
};

RobustWeight robust_weight(const PoseResidual& residual, const MeasuredNoise& noise)
{
    const cv::Matx33d inverse = covariance_of(residual, noise).inv();
    const double dimensions = residual.has_depth_equation ? 3 : 2;
    const double squared =
        squared_mahalanobis(residual, inverse) / dimensions / (kCauchy * kCauchy);
    const double weight = 1 / (1 + squared);
    return {weight * inverse, weight, weight * (1 - 2 * weight * squared / dimensions)};
}

NormalEquations normal_equations(const Residuals& residuals, const MeasuredNoise& noise)
{
    NormalEquations equations;
    for (const auto& residual : residuals)
    {
        const cv::Matx<double, 6, 3> left =
            residual.jacobian.t() * robust_weight(residual, noise).information;
        equations.information += left * residual.jacobian;
        equations.gradient += left * residual.value;
    }
    return equations;
}

/** What the matches of one region of the image say together. */
struct Region
{
    cv::Vec<double, 6> pull;  ///< towards a pose of its own
    double leverage = 0;  ///< its share of the six degrees of freedom
};

using Regions = std::map<std::pair<int, int>, Region>;

Regions regions_of(const Residuals& residuals,
                   const std::vector<PixelPosition>& pixels,
                   const MeasuredNoise& noise,
                   const cv::Matx66d& inverse_information)
{
    constexpr double kRegionPx = 80;  // as wide as the patches of large keypoints
    Regions regions;
    for (std::size_t k = 0; k < residuals.size(); ++k)
    {
        const auto& residual = residuals[k];
        const std::pair cell(
            static_cast<int>(std::floor(static_cast<double>(pixels[k].x) / kRegionPx)),
            static_cast<int>(std::floor(static_cast<double>(pixels[k].y) / kRegionPx)));
        const cv::Matx<double, 6, 3> left =
            residual.jacobian.t() * robust_weight(residual, noise).information;
        auto& region = regions[cell];
        region.pull += left * residual.value;
        region.leverage += cv::trace(inverse_information * (left * residual.jacobian)) / kUnknowns;
    }
    return regions;
}

/** Robust weights make the fit less steep than the normal equations say. */
double steepness_of(const Residuals& residuals, const MeasuredNoise& noise)
{
    double weights = 0;
    double slopes = 0;
    for (const auto& residual : residuals)
    {
        const auto robust = robust_weight(residual, noise);
        weights += robust.weight;
        slopes += robust.slope;
    }
    return weights / slopes;
}

/** As many regions of equal leverage would know as much. */
double effective_count(const Regions& regions)
{
    double sum = 0;
    double squares = 0;
    for (const auto& [cell, region] : regions)
    {
        sum += region.leverage;
        squares += region.leverage * region.leverage;
    }
    return sum * sum / squares;
}

/** By how much the covariance of the solution exceeds the inverse of the information: K.-Y. Liang,
 *  S. Zeger, "Longitudinal data analysis using generalized linear models", Biometrika 73 (1986),
 *  reduced to one factor, since few matches do not give a whole matrix. What neighbours pull the
 *  same way counts as one: keypoints of several sizes at one corner share their errors. Never less
 *  than a tenth, for copies of an image leave no residuals and are no endless precision; with few
 *  regions never less than 1. */
double variance_factor(const Residuals& residuals,
                       const std::vector<PixelPosition>& pixels,
                       const MeasuredNoise& noise,
                       const cv::Matx66d& inverse_information)
{
    constexpr double kLeast = 0.1;
    constexpr double kFewRegions = 8;
    constexpr double kFewEffective = 3;
    const auto regions = regions_of(residuals, pixels, noise, inverse_information);
    double sum = 0;
    for (const auto& [cell, region] : regions)
        sum += region.pull.dot(inverse_information * region.pull);
    // The fit gives way to each region's pull by its share of the six degrees of freedom; squared
    // as in the jackknife: J. MacKinnon, H. White, Journal of Econometrics 29 (1985), HC3.
    const double count = std::max(static_cast<double>(regions.size()), kFewRegions);
    const double give_way = count / (count - kUnknowns);
    const double correction = give_way * steepness_of(residuals, noise);
    // A variance that is estimated from few makes a Student's t of what was Gaussian.
    const double effective = std::max(effective_count(regions), kFewEffective);
    const double student = effective / (effective - 2);
    // The pulls of few regions all but cancel each other at the solution and tell nothing.
    const double least = static_cast<double>(regions.size()) < kFewRegions ? 1 : kLeast;
    return student * std::max(least, sum / kUnknowns * correction * correction);
}

RigidTransform moved(const RigidTransform& pose, const cv::Vec<double, 6>& step)
{
    return {pose.rotation * rotation_from_vector({step[3], step[4], step[5]}),
            pose.translation + cv::Vec3d(step[0], step[1], step[2])};
}
}  // namespace

std::vector<std::size_t> agreeing(const std::vector<MeasuredMatch>& matches,
                                  const PinholePair& cameras,
                                  const RigidTransform& candidate_from_query,
                                  const MeasuredNoise& noise)
{
    std::vector<std::size_t> indices;
    for (std::size_t k = 0; k < matches.size(); ++k)
    {
        const auto residual = pose_residual(matches[k], cameras, candidate_from_query);
        if (residual && agrees(*residual, noise)) indices.push_back(k);
    }
    return indices;
}

std::optional<RefinedPose> refined_pose(const std::vector<MeasuredMatch>& matches,
                                        const PinholePair& cameras,
                                        const RigidTransform& start)
{
    constexpr int kMaxIterations = 30;
    constexpr double kConverged = 1e-7;
    constexpr std::size_t kFewest = 6;
    RefinedPose refined{{start, {}}, {}, agreeing(matches, cameras, start, {})};
    auto& [pose, covariance] = refined.candidate_from_query;
    for (int i = 0; i < kMaxIterations; ++i)
    {
        if (refined.inliers.size() < kFewest) return std::nullopt;
        const auto residuals = residuals_of(matches, cameras, pose, refined.inliers);
        refined.noise.pixel_deviation_px = measured_pixel_deviation(residuals, refined.noise);
        refined.noise.depth_factor = measured_depth_factor(residuals, refined.noise);
        const auto equations = normal_equations(residuals, refined.noise);
        bool solvable = false;
        covariance = equations.information.inv(cv::DECOMP_CHOLESKY, &solvable);
        if (!solvable) return std::nullopt;
        const cv::Vec<double, 6> step = covariance * -equations.gradient;
        pose = moved(pose, step);
        refined.inliers = agreeing(matches, cameras, pose, at_least_usual(refined.noise));
        if (cv::norm(step) < kConverged) break;
    }
    if (refined.inliers.size() < kFewest) return std::nullopt;
    std::vector<PixelPosition> pixels;
    pixels.reserve(refined.inliers.size());
    for (const auto k : refined.inliers) pixels.push_back(matches[k].query.pixel);
    const auto residuals = residuals_of(matches, cameras, pose, refined.inliers);
    covariance = covariance * variance_factor(residuals, pixels, refined.noise, covariance);
    return refined;
}

}  // namespace fild
