// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace fild
{
/** Direction of a movement. */
struct Heading
{
    double angle = 0;  ///< radians from the x axis (east)
    double baseline = 0;  ///< metres that the movement goes
};

/** Headings at all positions (metres east, north, up); where there is none, that of the nearest one
 *  (by count) before, or else after. Nothing when the robot never moved a baseline. */
std::vector<std::optional<Heading>> headings_of(const std::vector<Eigen::Vector3d>& positions,
                                                double baseline_m);

}  // namespace fild
