// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/angle.h"
#include "fild/graph/pose_graph.h"

#include <cstddef>
#include <vector>

namespace fild::testing
{
/** Information of errors of so many metres and radians along each axis. */
inline mrpt::math::CMatrixDouble66 information_of(double metres, double radians)
{
    mrpt::math::CMatrixDouble66 information;
    for (int i = 0; i < 6; ++i)
        information(i, i) = i < 3 ? 1 / (metres * metres) : 1 / (radians * radians);
    return information;
}

/** Corners of a square of 10 m, driven counter-clockwise `laps` times, the last pose on the first.
 */
inline std::vector<mrpt::poses::CPose3D> square_truth(std::size_t laps = 1)
{
    const mrpt::poses::CPose3D side(10, 0, 0, 90 * kRadiansPerDegree, 0, 0);
    std::vector<mrpt::poses::CPose3D> poses{mrpt::poses::CPose3D()};
    for (std::size_t i = 0; i < 4 * laps; ++i) poses.push_back(poses.back() + side);
    return poses;
}

/** A graph with odometry edges exactly as the poses are, no loops. */
inline PoseGraph graph_of(const std::vector<mrpt::poses::CPose3D>& poses)
{
    PoseGraph graph;
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        graph.nodes.push_back({FrameId{i}, static_cast<double>(i), poses[i]});
        if (i > 0)
            graph.odometry.push_back(
                {FrameId{i - 1}, FrameId{i}, poses[i] - poses[i - 1], information_of(0.1, 0.01)});
    }
    return graph;
}

/** The true loop between two nodes. */
inline GraphEdge loop_between(const std::vector<mrpt::poses::CPose3D>& poses,
                              std::size_t a,
                              std::size_t b)
{
    return {FrameId{a}, FrameId{b}, poses[b] - poses[a], information_of(0.05, 0.01)};
}

}  // namespace fild::testing
