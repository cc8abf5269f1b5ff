// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"

#include <set>
#include <vector>

namespace fild
{
/** The frames that become nodes of the pose graph, in increasing id.
 *
 *  The first and the last frame of each segment; each that is as far from the keyframe before, as
 *  much turned against it (by the angle of the whole rotation), or as much later as TGraphOptions
 *  say; and the `required` ones: those that take part in loops. Required frames without a pose are
 *  left out. A trajectory of one frame gives one keyframe: a map, but nothing to optimise.
 *  \throw std::invalid_argument on bad options. Deterministic. */
std::vector<FrameId> select_keyframes(const Trajectory& trajectory,
                                      const TGraphOptions& options,
                                      const std::set<FrameId>& required = {});

}  // namespace fild
