// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstdint>
#include <vector>

namespace fild
{
/** Pixel of each match in the query's image.
 *  \throw std::invalid_argument when an index is beyond the positions. */
std::vector<PixelPosition> query_pixels(const std::vector<Match>& matches,
                                        const std::vector<PixelPosition>& positions);

/** Pixel of each match in the candidate's image. \throw as query_pixels(). */
std::vector<PixelPosition> candidate_pixels(const std::vector<Match>& matches,
                                            const std::vector<PixelPosition>& positions);

/** OpenCV's kind of a seed. */
int usac_random_state(std::uint64_t seed);

}  // namespace fild
