// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace fild
{
/** What random numbers are drawn for. Each purpose has its own, so that a change of one part of a
 *  recording (its odometry, say) leaves all others as they were. */
enum class RandomPurpose : std::uint32_t
{
    lane_offset,
    heading,
    suspension,
    light,
    parked_cars,
    image_noise,
    odometry_bias,
    odometry_noise,
    gps,
    pedestrians,
    traffic,
    season
};

/** A generator of its own for each seed, purpose and index (a frame, a lap, a component); the
 *  same numbers with every standard library. */
std::mt19937_64 seeded_generator(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index);

}  // namespace fild
