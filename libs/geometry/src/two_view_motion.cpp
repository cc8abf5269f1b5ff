// SPDX-License-Identifier: BSD-3-Clause
#include "two_view_motion.h"

#include "pinhole.h"

#include <opencv2/calib3d.hpp>

#include <cmath>

namespace fild
{
namespace
{
constexpr std::size_t kFewest = 8;

/** Rays through the pixels of a match, at depth 1. */
struct RayPair
{
    cv::Vec3d a;
    cv::Vec3d b;
};

std::vector<RayPair> rays_of(const TwoViews& views)
{
    std::vector<RayPair> rays;
    rays.reserve(views.a.size());
    for (std::size_t k = 0; k < views.a.size(); ++k)
        rays.push_back(
            {ray_through(views.a_camera, views.a[k]), ray_through(views.b_camera, views.b[k])});
    return rays;
}

cv::Matx33d essential_matrix(const RigidTransform& b_from_a)
{
    return cross_matrix(b_from_a.translation) * b_from_a.rotation;
}

/** Sampson's distance at depth 1: signed, to first order that of the pair from one that fits. */
double sampson_distance(const cv::Matx33d& essential, const RayPair& rays)
{
    const cv::Vec3d in_b = essential * rays.a;
    const cv::Vec3d in_a = essential.t() * rays.b;
    const double squared =
        in_b[0] * in_b[0] + in_b[1] * in_b[1] + in_a[0] * in_a[0] + in_a[1] * in_a[1];
    return squared > 0 ? rays.b.dot(in_b) / std::sqrt(squared) : 0;
}

/** True when the point nearest to both rays lies before both cameras. */
bool is_in_front(const RigidTransform& b_from_a, const RayPair& rays)
{
    // z_b * b = z_a * R a + t, solved by the cross products with either ray.
    const cv::Vec3d a = b_from_a.rotation * rays.a;
    const cv::Vec3d normal = a.cross(rays.b);
    const double squared = normal.dot(normal);
    const double z_a = rays.b.cross(b_from_a.translation).dot(normal);
    const double z_b = a.cross(b_from_a.translation).dot(normal);
    return squared > 0 && z_a > 0 && z_b > 0;
}

std::vector<std::size_t> in_front_and_near(const std::vector<RayPair>& rays,
                                           const RigidTransform& b_from_a,
                                           double max_distance)
{
    const auto essential = essential_matrix(b_from_a);
    std::vector<std::size_t> indices;
    for (std::size_t k = 0; k < rays.size(); ++k)
        if (std::abs(sampson_distance(essential, rays[k])) <= max_distance &&
            is_in_front(b_from_a, rays[k]))
            indices.push_back(k);
    return indices;
}

/** Of the four movements that have this essential matrix, the one with most points in front. */
TwoViewMotion most_in_front(const cv::Mat& essential,
                            const std::vector<RayPair>& rays,
                            double max_distance)
{
    cv::Matx33d r1;
    cv::Matx33d r2;
    cv::Vec3d t;
    cv::decomposeEssentialMat(essential, r1, r2, t);
    TwoViewMotion best;
    for (const auto& candidate : {RigidTransform{r1, t},
                                  RigidTransform{r1, -t},
                                  RigidTransform{r2, t},
                                  RigidTransform{r2, -t}})
    {
        auto inliers = in_front_and_near(rays, candidate, max_distance);
        if (inliers.size() > best.inliers.size()) best = {candidate, std::move(inliers)};
    }
    return best;
}

using Step = cv::Vec<double, 5>;  ///< rotation vector, and the direction in two axes across it

RigidTransform moved(const RigidTransform& b_from_a, const Step& step)
{
    const auto& t = b_from_a.translation;
    const auto across = cv::normalize(std::abs(t[0]) < 0.7 ? t.cross(cv::Vec3d(1, 0, 0))
                                                           : t.cross(cv::Vec3d(0, 1, 0)));
    return {b_from_a.rotation * rotation_from_vector({step[0], step[1], step[2]}),
            cv::normalize(t + step[3] * across + step[4] * t.cross(across))};
}

/** Derivative of sampson_distance() by the step, by central differences. */
Step derivative(const std::array<std::pair<cv::Matx33d, cv::Matx33d>, 5>& disturbed,
                const RayPair& rays,
                double step)
{
    Step result;
    for (std::size_t i = 0; i < disturbed.size(); ++i)
        result[static_cast<int>(i)] = (sampson_distance(disturbed[i].first, rays) -
                                       sampson_distance(disturbed[i].second, rays)) /
                                      (2 * step);
    return result;
}

RigidTransform refined(const TwoViewMotion& motion,
                       const std::vector<RayPair>& rays,
                       double typical_distance)
{
    constexpr int kIterations = 15;
    constexpr double kStep = 1e-6;
    auto pose = motion.b_from_a;
    for (int i = 0; i < kIterations; ++i)
    {
        std::array<std::pair<cv::Matx33d, cv::Matx33d>, 5> disturbed;
        for (std::size_t k = 0; k < disturbed.size(); ++k)
        {
            Step step;
            step[static_cast<int>(k)] = kStep;
            disturbed[k] = {essential_matrix(moved(pose, step)),
                            essential_matrix(moved(pose, -step))};
        }
        const auto essential = essential_matrix(pose);
        cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
        Step gradient;
        for (const auto k : motion.inliers)
        {
            const double distance = sampson_distance(essential, rays[k]);
            const double ratio = distance / typical_distance;
            const double weight = 1 / (1 + ratio * ratio);
            const auto row = derivative(disturbed, rays[k], kStep);
            normal += weight * (row * row.t());
            gradient += weight * distance * row;
        }
        bool solvable = false;
        const cv::Matx<double, 5, 5> inverse = normal.inv(cv::DECOMP_CHOLESKY, &solvable);
        if (!solvable) break;
        const Step step = inverse * -gradient;
        pose = moved(pose, step);
        if (cv::norm(step) < 1e-9) break;
    }
    return pose;
}

cv::Mat ransac(const std::vector<RayPair>& rays, double max_distance, int random_state)
{
    std::vector<cv::Point2d> a;
    std::vector<cv::Point2d> b;
    a.reserve(rays.size());
    b.reserve(rays.size());
    for (const auto& [in_a, in_b] : rays)
    {
        a.emplace_back(in_a[0], in_a[1]);
        b.emplace_back(in_b[0], in_b[1]);
    }
    cv::UsacParams usac;
    usac.confidence = 0.999;
    usac.isParallel = false;  // a parallel RANSAC would not repeat
    usac.maxIterations = 2000;
    usac.randomGeneratorState = random_state;
    usac.threshold = max_distance;
    usac.loMethod = cv::LOCAL_OPTIM_SIGMA;
    usac.score = cv::SCORE_METHOD_MAGSAC;
    const cv::Mat no_distortion;
    std::vector<unsigned char> is_inlier;
    const auto eye = cv::Matx33d::eye();
    return cv::findEssentialMat(a, b, eye, eye, no_distortion, no_distortion, is_inlier, usac);
}
}  // namespace

std::optional<TwoViewMotion> two_view_motion(const TwoViews& views,
                                             double max_error_px,
                                             int random_state)
{
    if (views.a.size() < kFewest) return std::nullopt;
    const auto rays = rays_of(views);
    const double max_distance =
        max_error_px / std::sqrt(std::sqrt(views.a_camera.fx * views.a_camera.fy *
                                           views.b_camera.fx * views.b_camera.fy));
    const cv::Mat essential = ransac(rays, max_distance, random_state);
    if (essential.rows != 3 || essential.cols != 3) return std::nullopt;
    auto motion = most_in_front(essential, rays, max_distance);
    if (motion.inliers.size() < kFewest) return std::nullopt;
    motion.b_from_a = refined(motion, rays, max_distance / 3);
    motion.inliers = in_front_and_near(rays, motion.b_from_a, max_distance);
    if (motion.inliers.size() < kFewest) return std::nullopt;
    return motion;
}

}  // namespace fild
