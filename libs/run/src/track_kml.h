// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/mapping/map_builder.h"

#include <string>

namespace fild
{
/** Writes the way before and after the loops, and the loops with a weight, as KML that Google Earth
 *  opens; on the ground, as heights of GPS are coarse.
 *  \param map  with an origin. \throw std::runtime_error when the file cannot be written. */
void write_track_kml(const Map& map, const std::string& path);

}  // namespace fild
