// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/loop_edge.h"

#include "fild/graph/graph_builder.h"
#include "fild/rawlog/pose_conversion.h"

#include <mrpt/poses/CPose3DPDFGaussianInf.h>

#include <stdexcept>

namespace fild
{
std::string to_word(Withheld reason)
{
    switch (reason)
    {
        case Withheld::none:
            return "";
        case Withheld::not_enabled:
            return "not_enabled";
        case Withheld::not_calibrated:
            return "not_calibrated";
        case Withheld::distorted:
            return "distorted";
        case Withheld::no_odometry:
            return "no_odometry";
        case Withheld::no_depth:
            return "no_depth";
        case Withheld::too_few_points:
            return "too_few_points";
        case Withheld::no_model:
            return "no_model";
        case Withheld::degenerate:
            return "degenerate";
        case Withheld::disagreement:
            return "disagreement";
        case Withheld::stood_still:
            return "stood_still";
        case Withheld::singular_covariance:
            return "singular_covariance";
        case Withheld::frame_without_pose:
            return "frame_without_pose";
    }
    return "";
}

namespace
{
RigidTransform robot_from_camera(const MetricView& view)
{
    return view.robot_from_camera.value_or(RigidTransform());
}
}  // namespace

std::optional<RelativeMotion> robot_motion(const UncertainTransform& candidate_from_query,
                                           const MetricView& candidate,
                                           const MetricView& query)
{
    try
    {
        const auto constraint = robot_constraint(
            candidate_from_query, robot_from_camera(candidate), robot_from_camera(query));
        RelativeMotion motion;
        motion.a_from_b = constraint.mean;
        const auto covariance = constraint.cov_inv.inverse_LLt();
        for (int row = 0; row < 6; ++row)  // symmetric but for rounding
            for (int column = 0; column < 6; ++column)
                motion.covariance(row, column) =
                    (covariance(row, column) + covariance(column, row)) / 2;
        if (is_usable(motion)) return motion;
    }
    catch (const std::invalid_argument&)  // no covariance that an edge could have
    {
    }
    return std::nullopt;
}

UnscaledMotion unscaled_motion(const RigidTransform& candidate_from_query_unscaled,
                               const MetricView& candidate,
                               const MetricView& query)
{
    const cv::Matx33d candidate_rotation = robot_from_camera(candidate).rotation;
    const cv::Matx33d query_rotation = robot_from_camera(query).rotation;
    return {candidate_rotation * candidate_from_query_unscaled.rotation * query_rotation.t(),
            candidate_rotation * candidate_from_query_unscaled.translation};
}

}  // namespace fild
