// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/rigid_transform.h"

namespace mrpt::poses
{
class CPose3D;
class CPose3DPDFGaussianInf;
}  // namespace mrpt::poses

namespace fild
{
/** The pose as `core` knows it: of frame a in frame b, and the transform b_from_a. */
RigidTransform rigid_transform_from(const mrpt::poses::CPose3D& pose);

/** The pose as MRPT knows it. */
mrpt::poses::CPose3D mrpt_pose_from(const RigidTransform& b_from_a);

/** The constraint between two poses of the robot that two camera frames give.
 *
 *  The mean is the query robot's pose in the candidate robot's frame: what an edge from the
 *  candidate's node to the query's node of MRPT's graphs carries. The information matrix is that of
 *  (x, y, z, yaw, pitch, roll), the order of CPose3DPDFGaussianInf, to first order.
 *  \param candidate_from_query  between the camera frames.
 *  \param candidate_robot_from_camera,query_robot_from_camera  where each camera was on the robot,
 *         taken as exact.
 *  \throw std::invalid_argument when the covariance is not positive definite, or yaw, pitch and
 *         roll have no covariance because the pitch is 90 degrees, up to 0.01. */
mrpt::poses::CPose3DPDFGaussianInf robot_constraint(
    const UncertainTransform& candidate_from_query,
    const RigidTransform& candidate_robot_from_camera,
    const RigidTransform& query_robot_from_camera);

}  // namespace fild
