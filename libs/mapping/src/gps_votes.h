// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gps_track.h"

#include <vector>

namespace fild
{
/** Which receivers are wrong, by comparison with each other at the times of the camera frames: two
 *  agree when in the median they are no further apart than their uncertainties and their places on
 *  the robot allow. A receiver is contradicted when it agrees with fewer others than it disagrees
 *  with; of two that disagree it is the less certain one.
 *  \param tracks  the most certain first. \return for each track. */
std::vector<bool> contradicted_tracks(const std::vector<GpsTrack>& tracks);

}  // namespace fild
