// SPDX-License-Identifier: BSD-3-Clause
// Distances from epipolar lines to first order: P. D. Sampson, "Fitting conic sections to very
// scattered data", Computer Graphics and Image Processing 18 (1982).
#include "pair_motion.h"

#include "pinhole.h"

#include <opencv2/core.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace fild
{
namespace
{
/** A rotation vector, and the movement ahead and aside, both across the baseline. */
using Motion = cv::Vec<double, 5>;

struct MatchedRays
{
    cv::Vec3d left;
    cv::Vec3d right;
};

/** Two unit vectors at right angles to the baseline and to each other. */
struct Across
{
    explicit Across(const cv::Vec3d& baseline)
    {
        const auto along = cv::normalize(baseline);
        const bool is_beside = std::abs(along[0]) > std::abs(along[1]);
        ahead = cv::normalize(along.cross(is_beside ? cv::Vec3d(0, 1, 0) : cv::Vec3d(1, 0, 0)));
        aside = along.cross(ahead);
    }

    cv::Vec3d ahead;
    cv::Vec3d aside;
};

class EpipolarFit
{
 public:
    EpipolarFit(const Frame& frame, std::vector<MatchedRays> rays, double pixel_deviation)
        : nominal_(frame.right->left_from_right),
          across_(nominal_.translation),
          lengths_(frame.camera->fx / pixel_deviation),
          rays_(std::move(rays))
    {
        const double seconds = std::abs(frame.right->seconds_later);
        for (int i = 0; i < 3; ++i) deviations_[i] = 0.3 * seconds;  // radians
        deviations_[3] = 10 * seconds;  // metres, ahead
        deviations_[4] = seconds;
    }

    RigidTransform solve() const
    {
        constexpr int kSteps = 8;
        Motion motion = Motion::all(0);
        for (int i = 0; i < kSteps; ++i) motion += step_from(motion);
        return moved(motion);
    }

 private:
    RigidTransform moved(const Motion& motion) const
    {
        const auto turn = rotation_from_vector({motion[0], motion[1], motion[2]});
        return {turn * nominal_.rotation,
                nominal_.translation + motion[3] * across_.ahead + motion[4] * across_.aside};
    }

    /** From the epipolar line, as a multiple of the usual one. */
    double distance(const MatchedRays& rays, const cv::Matx33d& essential) const
    {
        const auto line_left = essential * rays.right;
        const auto line_right = essential.t() * rays.left;
        const double scale =
            std::sqrt(line_left[0] * line_left[0] + line_left[1] * line_left[1] +
                      line_right[0] * line_right[0] + line_right[1] * line_right[1]);
        return lengths_ * rays.left.dot(line_left) / scale;
    }

    cv::Matx33d essential_at(const Motion& motion) const
    {
        const auto pose = moved(motion);
        return cross_matrix(pose.translation) * pose.rotation;
    }

    /** Gauss-Newton, with weights for errors that spread as Cauchy's distribution. */
    Motion step_from(const Motion& motion) const
    {
        constexpr double kDifference = 1e-6;
        const auto here = essential_at(motion);
        std::array<cv::Matx33d, 5> beside;
        for (int k = 0; k < 5; ++k)
        {
            auto near = motion;
            near[k] += kDifference;
            beside.at(static_cast<std::size_t>(k)) = essential_at(near);
        }
        cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
        Motion gradient = Motion::all(0);
        for (int k = 0; k < 5; ++k)
        {
            const double weight = 1 / (deviations_[k] * deviations_[k]);
            normal(k, k) += weight;
            gradient[k] += weight * motion[k];
        }
        for (const auto& rays : rays_)
        {
            const double error = distance(rays, here);
            Motion slope;
            for (int k = 0; k < 5; ++k)
                slope[k] =
                    (distance(rays, beside.at(static_cast<std::size_t>(k))) - error) / kDifference;
            const double weight = 1 / (1 + error * error);
            normal += weight * slope * slope.t();
            gradient += weight * error * slope;
        }
        return -(normal.inv(cv::DECOMP_CHOLESKY) * gradient);
    }

    RigidTransform nominal_;
    Across across_;
    double lengths_;  ///< in a focal length
    std::vector<MatchedRays> rays_;
    Motion deviations_;  ///< of a robot that moves as robots do
};
}  // namespace

RigidTransform pose_of_moved_right(const Frame& frame,
                                   const std::vector<PixelPosition>& left,
                                   const std::vector<PixelPosition>& right,
                                   const std::vector<Match>& matches,
                                   double pixel_deviation)
{
    constexpr std::size_t kEnough = 20;
    const auto& view = *frame.right;
    if (view.seconds_later == 0 || matches.size() < kEnough) return view.left_from_right;
    std::vector<MatchedRays> rays;
    rays.reserve(matches.size());
    for (const auto& match : matches)
        rays.push_back({ray_through(*frame.camera, left[match.query]),
                        ray_through(view.camera, right[match.candidate])});
    return EpipolarFit(frame, std::move(rays), pixel_deviation).solve();
}

}  // namespace fild
