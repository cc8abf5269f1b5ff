// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/pose_graph.h"
#include "gps_track.h"

#include <set>
#include <vector>

namespace fild
{
/** Priors of keyframes by a receiver: each by the position nearest to it in time, at most half of
 *  TGraphOptions::max_gap_s away. Between the two the robot moved as `motion` says, so that
 *  GraphPrior::robot_from_point is where the antenna was then. A position serves one keyframe, for
 *  the errors of fixes near each other are nearly the same.
 *  \param variance_scale  factor of the positions' covariances. */
std::vector<GraphPrior> priors_of(const GpsTrack& track,
                                  const Trajectory& motion,
                                  const std::set<FrameId>& keyframes,
                                  double max_gap_s,
                                  double variance_scale);

/** The motion, turned and moved to where the priors say: each segment by a turn about the vertical,
 *  or in space where only that fits and the robot's axes are those of a camera (which does not know
 *  how it is fixed to the robot). A
 *  segment without priors goes with the one before. Priors far from the others count little. */
Trajectory placed_by(const std::vector<GraphPrior>& priors, const Trajectory& motion);

}  // namespace fild
