// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace fild
{
/** Where the robot was at a keyframe. Value type. */
struct GraphNode
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    mrpt::poses::CPose3D map_from_robot;
};

/** What was measured between two keyframes. Value type. */
struct GraphEdge
{
    FrameId a{};
    FrameId b{};
    mrpt::poses::CPose3D a_from_b;  ///< pose of the robot at b, seen from the robot at a
    /** Inverse covariance of (x y z yaw pitch roll) of `a_from_b`, as that of
     *  mrpt::poses::CPose3DPDFGaussianInf; symmetric, positive definite. */
    mrpt::math::CMatrixDouble66 information;
};

/** Where a point of the robot, such as an antenna, was in the map at a keyframe. Value type. */
struct GraphPrior
{
    FrameId frame{};
    mrpt::math::TPoint3D map_from_point;  ///< metres
    mrpt::math::TPoint3D robot_from_point;  ///< metres, in the robot's axes
    /** Inverse covariance of `map_from_point` along the map's axes; symmetric, positive definite.
     *  */
    mrpt::math::CMatrixDouble33 information;
};

/** A pose graph. Value type. */
struct PoseGraph
{
    std::vector<GraphNode> nodes;  ///< in increasing frame
    std::vector<GraphEdge> odometry;  ///< each between nodes that follow each other
    std::vector<GraphEdge> loops;  ///< in any order; `a` the candidate, `b` the query
    std::vector<GraphPrior> priors{};  ///< in any order; a node may have several

    /** \throw std::invalid_argument naming the first node or edge that is wrong: nodes that do not
     *  increase, an edge from a node to itself or to one that is not there, odometry between nodes
     *  that do not follow each other, a prior of a node that is not there, numbers that are not
     *  finite, information that is not symmetric or not positive definite. */
    void check() const;

    /** Index into `nodes`. \throw std::invalid_argument when there is no such node. */
    std::size_t index_of(FrameId frame) const;
};

/** The nodes that edges hold together, and priors by the map's axes; each part in increasing order,
 *  the largest part first (of equal ones, that which begins first). More than one: the graph is
 *  disconnected, and where its parts lie to each other is unknown. */
std::vector<std::vector<FrameId>> connected_parts(const PoseGraph& graph);

/** The graph of some of its nodes, with the edges between them and their priors.
 *  \throw std::invalid_argument when one of the frames is no node. */
PoseGraph part_of(const PoseGraph& graph, const std::vector<FrameId>& frames);

}  // namespace fild
