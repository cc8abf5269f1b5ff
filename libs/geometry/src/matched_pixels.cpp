// SPDX-License-Identifier: BSD-3-Clause
#include "matched_pixels.h"

#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
std::vector<PixelPosition> pixels_of(const std::vector<Match>& matches,
                                     std::size_t Match::*side,
                                     const std::vector<PixelPosition>& positions)
{
    std::vector<PixelPosition> pixels;
    pixels.reserve(matches.size());
    for (const auto& match : matches)
    {
        if (match.*side >= positions.size())
            throw std::invalid_argument("a match names keypoint " + std::to_string(match.*side) +
                                        " of " + std::to_string(positions.size()));
        pixels.push_back(positions[match.*side]);
    }
    return pixels;
}
}  // namespace

std::vector<PixelPosition> query_pixels(const std::vector<Match>& matches,
                                        const std::vector<PixelPosition>& positions)
{
    return pixels_of(matches, &Match::query, positions);
}

std::vector<PixelPosition> candidate_pixels(const std::vector<Match>& matches,
                                            const std::vector<PixelPosition>& positions)
{
    return pixels_of(matches, &Match::candidate, positions);
}

int usac_random_state(std::uint64_t seed)
{
    return static_cast<int>(seed % 0x7FFFFFFFU);
}

}  // namespace fild
