// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/graph/trajectory.h"
#include "fild/mapping/pair_poses.h"
#include "fild/places/place_map.h"

#include <cstddef>

namespace fild
{
/** Quartiles of measurements. Value type. */
struct Quartiles
{
    std::size_t count = 0;
    double lower = 0;
    double median = 0;
    double upper = 0;
};

/** How the movements that the images tell agree with those of the recorded trajectory. Value type.
 */
struct MotionAgreement
{
    /** Angle between the two directions of a movement, or between the axes of a turn, whichever is
     *  larger, degrees. */
    Quartiles direction_error_deg;
    /** The same if each camera's pose were followed by the turn from the axes of a robot (x
     *  forward, z up) to those of a camera (z forward, y down): the turn that is easily forgotten.
     *  */
    Quartiles turned_direction_error_deg;
    /** Length of a movement by the images, divided by that of the trajectory: only with depths. */
    Quartiles length_ratio;

    /** Directions are wrong everywhere, and in the same way. */
    bool contradicts_directions() const;
    /** The pose of the camera lacks that turn. */
    bool lacks_turn() const;
    /** Lengths are wrong everywhere, and in the same way. */
    bool contradicts_lengths() const;
};

/** Compares some pairs of frames near each other, evenly over the trajectory, in each of which the
 *  robot moved at least 0.3 m or turned at least 5 degrees, or the images say so. Deterministic,
 *  with any number of threads.
 *  \param trajectory  recorded, not made of the images.
 *  \param times receives "motion_agreement", and within it "matching", "verification" and
 *         "relative_pose". */
MotionAgreement compare_motions(const PlaceMap& places,
                                const Trajectory& trajectory,
                                const TDetectorOptions& options,
                                StageTimes& times,
                                const CheckCancelled& check_cancelled);

}  // namespace fild
