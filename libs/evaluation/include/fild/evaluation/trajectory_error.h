// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/frame_poses.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** How a trajectory is compared with the truth. */
struct TrajectoryErrorOptions
{
    /** Also scale the trajectory to the size of the truth: for one camera, which knows no metres.
     */
    bool align_scale = false;
    std::vector<double> step_lengths = {10, 100};  ///< of the true way, metres, each above 0
};

/** Relative pose error (RPE) over all steps of one length. A step goes from a pose to the first one
 *  that is at least so far away along the true way; its error is the pose that is left when the
 *  true step is taken out of the estimated one. */
struct StepError
{
    double length = 0;  ///< metres, that was asked for
    std::size_t steps = 0;  ///< at least 1
    double translation_rmse = 0;  ///< metres
    double translation_percent = 0;  ///< mean of error / length of the step
    double rotation_deg_per_m = 0;  ///< mean of angle / length of the step
};

/** Errors of a trajectory. */
struct TrajectoryError
{
    std::size_t pairs = 0;  ///< poses that were compared
    double scale = 1;  ///< the trajectory was multiplied by; 1 unless it was asked for
    double ate_rmse = 0;  ///< absolute trajectory error: of the positions after alignment, metres
    std::vector<StepError> steps;  ///< of the lengths that the true way has
};

/** Compares a trajectory with the truth. Each true pose is paired with the one nearest in time, at
 *  most kMaxPoseTimeDifference away. The trajectory is then laid over the truth by the rotation and
 *  translation (and scale) that make the squared distances of the positions least (S. Umeyama,
 *  "Least-squares estimation of transformation parameters between two point patterns", PAMI 1991).
 *
 *  A constant rotation between the bodies whose poses they are (a camera's axes and a robot's) is
 *  estimated and taken out of the RPE; the distance between the two bodies is not.
 *  \param oriented_truth  false: the true orientations are not measured, no RPE is made.
 *  \throw std::invalid_argument on a step length that is not above 0.
 *  \throw std::runtime_error when fewer than 3 poses are paired, or none of them moves and scale is
 *         asked for. */
TrajectoryError trajectory_error(const std::vector<TimedPose>& trajectory,
                                 const std::vector<PosedFrame>& truth,
                                 bool oriented_truth,
                                 const TrajectoryErrorOptions& options);

/** The truth laid over the trajectory as trajectory_error() lays the trajectory over the truth,
 *  without scaling, and with the axes of the trajectory's body: a constant rotation between the two
 *  bodies is taken out. One that permutes the axes to 5 degrees is taken out exactly, so that
 *  errors of the trajectory do not turn the truth.
 *  \throw std::runtime_error when fewer than 3 poses are paired. */
std::vector<PosedFrame> laid_over(const std::vector<TimedPose>& trajectory,
                                  std::vector<PosedFrame> truth);

}  // namespace fild
