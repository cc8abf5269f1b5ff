// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace fild
{
/** What a source of motion is to the map. Value type. */
struct MotionSourceUse
{
    std::string kind;  ///< odometry, vision or gps
    std::string name;  ///< "CObservationOdometry 'ODOMETRY'"
    /** Motions between frames that the source has a part in; of GPS positions of keyframes. */
    std::size_t factors = 0;
    std::size_t without_weight = 0;  ///< positions that the rest of the graph contradicts
    std::size_t contradictions = 0;  ///< motions that odometry and images tell differently
    /** Standard deviations of the source in this recording, divided by the stated ones; in [1, 10].
     *  The covariances of its factors are multiplied by the square of it. */
    double noise_scale = 1;
    std::string left_out{};  ///< the reason when it has no part in the map; empty when it has
};

}  // namespace fild
