// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace fild
{
/** A number for each state of PlaceBelief's model: a probability, or how likely what was seen is in
 *  that state. Value type. */
struct PlaceStates
{
    double new_ground = 0;
    std::vector<double> same;  ///< at each place of the map
    std::vector<double> look_alike;  ///< at a look-alike of each place

    double sum() const;
    /** Divides all by their sum. */
    void normalize();
    /** State by state. \pre as many places. */
    PlaceStates& operator*=(const PlaceStates& other);
};

/** A place that a frame may show, after the comparison: a jump or a return ends at one of them. */
struct Entrance
{
    std::size_t place = 0;
    double was_near = 0;  ///< probability that the camera was near it, before the frame
};

/** What one frame tells the model. */
struct PlaceEvidence
{
    bool has_moved = true;  ///< false: the frame before was of the same instant
    std::vector<Entrance> entrances;
    PlaceStates likelihood;  ///< of the comparisons, in each state; 1 on new ground
};

double sum_of(const std::vector<double>& values);

/** Sums of the first 0, 1, ... values. */
std::vector<double> running_sums(const std::vector<double>& values);

/** Sum of the values within `reach` of the i-th on either side, from their running sums. */
double sum_around(const std::vector<double>& sums, std::size_t i, int reach);

/** Each value spread evenly over the places up to `step` before and after it; what would fall off
 *  the ends is lost. As a matrix it is symmetric. */
std::vector<double> spread(const std::vector<double>& values, int step);

}  // namespace fild
