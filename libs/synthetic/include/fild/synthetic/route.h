// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/synthetic/street_grid.h"

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>

#include <cstdint>
#include <vector>

namespace fild
{
/** Section [route] of synthetic-rawlog: where the robot drives. */
struct TRouteOptions : Options
{
    int laps = 2;  ///< rounds of the circuit
    int circuit_columns = 2;  ///< house blocks that the circuit goes round, along x
    int circuit_rows = 1;  ///< along y
    /** How many blocks of the circuit's far street (the one of largest y) are driven once more, in
     *  the opposite direction. The way there, round the blocks behind that street, is driven once
     *  only. */
    int opposite_blocks = 1;
    double speed_m_per_s = 5;  ///< on straight streets; corners are driven more slowly
    double frames_per_second = 2;
    double lane_offset_m = 0.2;  ///< standard deviation of the way beside the middle of the lane
    /** Every second lap is driven this far to the left of the right-hand lane: at 2.5 and more in
     * the other lane. The change takes the first and the last 25 m of that lap. */
    double lap_offset_m = 0;
    /** In every second lap the robot looks aside by up to this angle: to the left in the first half
     *  of the lap, to the right in the second. It drives on as before: the true heading is turned.
     */
    double lap_view_deg = 0;
    double heading_noise_deg = 1;  ///< standard deviation of the heading against the way's
    double suspension_deg = 0.3;  ///< standard deviation of roll and of pitch
    int max_frames = 0;  ///< the route ends after so many; 0: all of it is driven

    /** \throw std::invalid_argument when the streets do not suffice for the route. */
    void check_fits(const StreetGrid& grid) const;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** The parts of a route. */
enum class Stretch
{
    lap,  ///< on the circuit
    link,  ///< between the others, not far from the circuit
    once,  ///< more than 20 m from laps and opposite stretch
    opposite  ///< on a street of the circuit, against the circuit's direction
};

/** Where the robot is when a frame is taken. Value type. */
struct RoutePose
{
    double seconds = 0;  ///< since the start
    int lap = 0;  ///< from 0; what follows the last lap counts as part of it
    Stretch stretch = Stretch::lap;
    mrpt::math::TPose3D map_from_robot{};  ///< x forward, y left, z up, on the road
    /** The middle of the right-hand lane beside the robot; x along the lane. */
    mrpt::math::TPose2D map_from_lane{};
    double lane_metres = 0;  ///< along the lane, since the start
    double lane_left_m = 0;  ///< how far to the left of the lane the lap is driven
};

/** Plans a route: laps round the blocks at the origin, counter-clockwise, driving on the right; on
 *  from the corner of largest x and y, round the blocks behind, and back on the circuit's far
 * street against the circuit's direction. Offset from the lane, heading noise, roll and pitch are
 * smooth and differ from lap to lap. \return a pose a frame, in order of time; frame k is at k /
 * frames_per_second. Deterministic by seed. \throw std::invalid_argument on bad options, or as
 * check_fits(). */
std::vector<RoutePose> plan_route(const TRouteOptions& options,
                                  const StreetGrid& grid,
                                  std::uint64_t seed);

/** Metres driven: the sum of the distances between following poses. */
double driven_metres(const std::vector<RoutePose>& route);

}  // namespace fild
