// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/pose_graph.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace fild
{
/** Writes a graph for MRPT's graph-slam and CNetworkOfPoses: node ids are frame numbers, the first
 *  node is fixed (a line FIX, MRPT's root).
 *
 *  spatial: TORO's VERTEX3 and EDGE3, angles as roll pitch yaw, rows of the information likewise.
 *  planar: VERTEX_SE2 and EDGE_SE2, made of x, y and yaw; their information is what remains of the
 *  covariance, not a part of the information.
 *  Priors are not written. MRPT 2.5 optimises only connected graphs: write the largest of
 *  connected_parts() of the graph without its priors.
 *  \throw std::invalid_argument on a bad graph, std::runtime_error when the file cannot be written.
 */
void write_mrpt_graph(const std::string& path, const PoseGraph& graph, GraphDimensions dimensions);

/** Writes VERTEX_SE3:QUAT and EDGE_SE3:QUAT for g2o. Its error of rotation is the vector part of a
 *  unit quaternion, half of the rotation vector: the information of rotations is 4 times, and that
 *  of rotations with translations twice, what it is for a rotation vector. No line FIX, which only
 *  g2o knows: it fixes a node by itself, other readers stop there. Throws as write_mrpt_graph(). */
void write_g2o(const std::string& path, const PoseGraph& graph);

/** Gives what was observed at a node's frame. */
using ObservationsAt =
    std::function<std::vector<std::shared_ptr<mrpt::obs::CObservation>>(FrameId)>;

/** Writes a mrpt::maps::CSimpleMap: the pose of each node and what was observed there. Images that
 *  are stored outside stay outside: who reads the map sets
 *  mrpt::img::CImage::setImagesPathBase() to the rawlog's folder of images. The poses are given
 *  without uncertainty (covariance 0).
 *  \param observations_at  called once for each node, in their order; what it gives is written and
 *  let go before the next call.
 *  \throw std::runtime_error when the file cannot be written; what observations_at throws. */
void write_simple_map(const std::string& path,
                      const PoseGraph& graph,
                      const ObservationsAt& observations_at);

}  // namespace fild
