// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <vector>

namespace fild
{
/** A random curve that wanders about 0 with a standard deviation of 1, twice continuously
 *  differentiable: a uniform cubic B-spline over normally distributed knots. Values more than about
 *  1.5 knot distances apart are independent. Bounded by kMaximum. Const members may run
 *  concurrently. */
class SmoothNoise
{
 public:
    /** No value is further from 0. */
    static constexpr double kMaximum = 3.6;

    /** \param length  the curve is for 0 <= s <= length. \param knot_distance  > 0.
     *  \throw std::invalid_argument when the length is negative or the distance not positive. */
    SmoothNoise(double length, double knot_distance, std::mt19937_64 generator);

    /** \param s  clamped to [0, length]. */
    double value(double s) const;
    /** Of the value by s. */
    double derivative(double s) const;

 private:
    struct Place;
    Place find(double s) const;

    double length_;
    double knot_distance_;
    std::vector<double> knots_;
};

}  // namespace fild
