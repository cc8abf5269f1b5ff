// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"

#include <cstddef>
#include <map>
#include <string>

namespace fild
{
/** One run of MRPT's graph-SLAM engine. */
struct EngineRequest
{
    std::string rawlog;
    std::string config;  ///< .ini of the engine
    std::string output;  ///< folder
    GraphDimensions dimensions = GraphDimensions::spatial;
    bool with_loops = true;  ///< false: CEmptyERD decides on edges
    bool quiet = false;
};

/** What came out. */
struct EngineResult
{
    std::size_t nodes = 0;
    std::size_t odometry_edges = 0;
    std::size_t loop_edges = 0;
    std::map<std::string, std::size_t> withheld;  ///< loop closures without an edge, by reason
};

/** Runs mrpt::graphslam::CGraphSlamEngine over the rawlog without a window, with COdometryNRD,
 *  CVisualLoopERD and CLevMarqGSO, optimises the whole graph once more, and writes poses.graph and
 *  trajectory.tum, each when it is whole, into the output folder.
 *  \throw std::runtime_error when the rawlog, a configuration or the folder is not as it must be,
 *         when no node came of the odometry, or the user interrupts: nothing is written then. */
EngineResult run_engine(const EngineRequest& request);

}  // namespace fild
