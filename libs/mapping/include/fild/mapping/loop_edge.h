// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/geometry/relative_pose.h"
#include "fild/graph/loop_selection.h"
#include "fild/graph/trajectory.h"
#include "fild/places/place.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Why a loop closure is no edge of the pose graph. */
enum class Withheld
{
    none,  ///< it is one
    not_enabled,  ///< no metric poses were asked for
    not_calibrated,  ///< one of the cameras
    distorted,  ///< the lens distortion of one of the cameras was left in
    no_odometry,  ///< a single camera, and nothing tells how far it moved
    no_depth,  ///< no match has a depth in either frame: scale is unknown
    too_few_points,  ///< with depth, or that agree
    no_model,  ///< RANSAC found no pose
    degenerate,  ///< the points do not fix all six degrees of freedom well enough
    disagreement,  ///< too small a share of the verified matches agrees with the pose
    stood_still,  ///< the robot has not moved since a loop with the same place
    singular_covariance,  ///< of the pose between the robots: it would have no information
    frame_without_pose  ///< the input trajectory has no pose for one of the frames
};

/** The enumerator's name; empty for Withheld::none. */
std::string to_word(Withheld reason);

/** What two images tell of a movement whose length is unknown. Value type. */
struct UnscaledMotion
{
    cv::Matx33d rotation;  ///< of the query's robot in the candidate's frame
    /** In which the camera moved, in the axes of the candidate's robot; a unit vector. */
    cv::Vec3d direction;
};

/** What a loop closure is to the map. Value type. */
struct LoopEdge
{
    FrameId candidate{};
    FrameId query{};
    Withheld withheld = Withheld::none;  ///< why it is not in the graph
    /** From the candidate's robot to the query's, where it is known. */
    std::optional<RelativeMotion> motion{};
    std::optional<UnscaledMotion> unscaled{};  ///< where nothing tells the scale
    LoopResult result{};  ///< when it is in the graph
};

/** The motion of the robot that a metric pose between its cameras tells. Nothing when its
 *  covariance is singular, or the pose has no yaw, pitch and roll. A frame that does not know where
 *  its camera is on the robot counts as if the camera were the robot. */
std::optional<RelativeMotion> robot_motion(const UncertainTransform& candidate_from_query,
                                           const MetricView& candidate,
                                           const MetricView& query);

/** \param candidate_from_query_unscaled  between the cameras, as in RelativePose. */
UnscaledMotion unscaled_motion(const RigidTransform& candidate_from_query_unscaled,
                               const MetricView& candidate,
                               const MetricView& query);

}  // namespace fild
