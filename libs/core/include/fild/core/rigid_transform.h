// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/matx.hpp>

namespace fild
{
/** Rotation and translation that take points of frame a into frame b, by convention named
 *  `b_from_a`; at the same time the pose of a in b. Metres. The default is the identity. */
struct RigidTransform
{
    cv::Matx33d rotation = cv::Matx33d::eye();
    cv::Vec3d translation;

    /** The point of frame a, in frame b. */
    cv::Vec3d operator*(const cv::Vec3d& point_in_a) const
    {
        return rotation * point_in_a + translation;
    }

    /** c_from_b * b_from_a is c_from_a. */
    RigidTransform operator*(const RigidTransform& b_from_a) const
    {
        return {rotation * b_from_a.rotation, *this * b_from_a.translation};
    }

    /** a_from_b. */
    RigidTransform inverse() const { return {rotation.t(), -(rotation.t() * translation)}; }
};

/** A rigid transform known up to an error.
 *
 *  The six errors are (x, y, z) of the translation, metres, in the axes of b, and a rotation vector
 *  w, radians, in the axes of a: the truth is (rotation * exp([w]x), translation + (x, y, z)).
 *  `covariance` has them in this order. */
struct UncertainTransform
{
    RigidTransform b_from_a;
    cv::Matx66d covariance = cv::Matx66d::zeros();
};

/** The matrix that multiplies as the cross product does: cross_matrix(v) * p = v x p. */
cv::Matx33d cross_matrix(const cv::Vec3d& v);

/** Rotation about the axis of `w` by its length, radians; Rodrigues' formula. */
cv::Matx33d rotation_from_vector(const cv::Vec3d& w);

/** Inverse of rotation_from_vector(); length in [0, pi]. */
cv::Vec3d vector_from_rotation(const cv::Matx33d& rotation);

}  // namespace fild
