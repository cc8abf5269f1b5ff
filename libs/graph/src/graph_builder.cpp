// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/graph_builder.h"

#include "fild/graph/keyframes.h"
#include "information.h"

#include <set>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
GraphEdge edge_of(const LoopMeasurement& loop)
{
    require_information(loop.motion.a_from_b,
                        loop.motion.covariance,
                        "covariance of the loop from frame " +
                            std::to_string(to_index(loop.candidate)) + " to frame " +
                            std::to_string(to_index(loop.query)));
    return {loop.candidate, loop.query, loop.motion.a_from_b, inverse_of(loop.motion.covariance)};
}
}  // namespace

bool is_usable(const RelativeMotion& motion)
{
    try
    {
        require_information(motion.a_from_b, motion.covariance, "covariance");
        return true;
    }
    catch (const std::invalid_argument&)
    {
        return false;
    }
}

BuiltGraph build_pose_graph(const Trajectory& trajectory,
                            const std::vector<LoopMeasurement>& loops,
                            const TGraphOptions& options)
{
    BuiltGraph built;
    std::set<FrameId> required;
    for (const auto& loop : loops)
    {
        if (!trajectory.pose(loop.candidate) || !trajectory.pose(loop.query))
        {
            built.loops_without_pose.push_back(loop);
            continue;
        }
        built.graph.loops.push_back(edge_of(loop));
        required.insert({loop.candidate, loop.query});
    }
    for (const auto frame : select_keyframes(trajectory, options, required))
    {
        const auto pose = *trajectory.pose(frame);
        auto& nodes = built.graph.nodes;
        if (!nodes.empty())
        {
            const auto before = nodes.back().frame;
            const auto motion = trajectory.motion(before, frame);
            if (motion)
                built.graph.odometry.push_back(
                    {before, frame, motion->a_from_b, inverse_of(motion->covariance)});
        }
        nodes.push_back({frame, pose.timestamp, pose.map_from_robot});
    }
    built.graph.check();
    return built;
}

}  // namespace fild
