// SPDX-License-Identifier: BSD-3-Clause
#include "smooth_noise.h"

#include "fild/core/random.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
/** Knots are clipped here: the value, a weighted mean of knots times kKnotDeviation, is then at
 *  most SmoothNoise::kMaximum. */
constexpr double kMaxKnot = 2.48;
/** The value's variance is that of the knots times sum of squared weights, 0.479 on average over a
 *  knot distance (the integral of the squared cubic B-spline, 151/315). */
constexpr double kKnotDeviation = 1.4443;

double clipped_normal(std::mt19937_64& generator)
{
    return std::clamp(standard_normal(generator), -kMaxKnot, kMaxKnot);
}
}  // namespace

/** Between which knots a place lies, and how far between them, [0, 1]. */
struct SmoothNoise::Place
{
    std::size_t first_knot;  ///< of the four that count
    double share;
};

SmoothNoise::SmoothNoise(double length, double knot_distance, std::mt19937_64 generator)
    : length_(length), knot_distance_(knot_distance)
{
    if (!(length >= 0 && knot_distance > 0))
        throw std::invalid_argument("SmoothNoise: length=" + std::to_string(length) +
                                    ", knot_distance=" + std::to_string(knot_distance));
    const auto spans = static_cast<std::size_t>(length / knot_distance) + 1;
    knots_.resize(spans + 3);
    for (auto& knot : knots_) knot = kKnotDeviation * clipped_normal(generator);
}

SmoothNoise::Place SmoothNoise::find(double s) const
{
    const double in_knots = std::clamp(s, 0.0, length_) / knot_distance_;
    const double whole = std::floor(in_knots);
    return {static_cast<std::size_t>(whole), in_knots - whole};
}

double SmoothNoise::value(double s) const
{
    const auto [i, t] = find(s);
    const double u = 1 - t;
    return (u * u * u * knots_[i] + (3 * t * t * t - 6 * t * t + 4) * knots_[i + 1] +
            (3 * u * u * u - 6 * u * u + 4) * knots_[i + 2] + t * t * t * knots_[i + 3]) /
           6;
}

double SmoothNoise::derivative(double s) const
{
    const auto [i, t] = find(s);
    const double u = 1 - t;
    return (-u * u * knots_[i] + (3 * t * t - 4 * t) * knots_[i + 1] +
            (4 * u - 3 * u * u) * knots_[i + 2] + t * t * knots_[i + 3]) /
           (2 * knot_distance_);
}

}  // namespace fild
