// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/results/frames_csv.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** A row of loops.csv: a loop closure, and what it is to the map. Value type. */
struct LoopRow : FrameRow
{
    using Three = std::array<double, 3>;

    /** Of the query's robot in the frame of the candidate's, metres; nothing where the scale is not
     *  known. */
    std::optional<Three> position;
    std::optional<Three> angles;  ///< of that pose: yaw, pitch, roll, radians
    std::optional<Three> position_deviations;  ///< standard deviations, metres
    std::optional<Three> angle_deviations;  ///< radians
    /** Where the scale is not known: a unit vector along which the camera moved, in the axes of the
     *  candidate's robot. */
    std::optional<Three> direction;
    std::optional<double> weight;  ///< in the optimised graph; nothing when it is no edge of it
    std::string edge;  ///< `used`, or why the loop is no edge or has no weight
};

/** The columns of frames.csv, then those of the map, with 6 decimals, angles in degrees; fields of
 *  what is not known are empty. */
CsvColumns<LoopRow> loops_csv_columns();

/** \throw std::runtime_error as read_csv(), and when only a part of a vector is there. */
std::vector<LoopRow> read_loops_csv(const std::string& path);

}  // namespace fild
