// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** How far matches may differ in rotation and scale and still agree. */
struct ShapeTolerance
{
    double angle_deg = 15;
    double octaves = 0.5;
};

/** The rotation and scale between two images on which most matches agree, read off the keypoints'
 *  orientations and sizes. */
struct DominantShape
{
    int angle_steps = 0;  ///< candidate minus query, in 1 / kStepsPerTurn of a turn
    int size_steps = 0;  ///< candidate minus query, in 1 / kStepsPerOctave octaves
    std::size_t agreeing = 0;  ///< matches within the tolerance
};

/** Rotation and scale of the match with which most matches agree, the first one in a tie. Cost
 *  quadratic in the matches. Without matches `agreeing` is 0. */
DominantShape dominant_shape(const std::vector<Match>& matches,
                             const std::vector<KeypointShape>& query,
                             const std::vector<KeypointShape>& candidate,
                             const ShapeTolerance& tolerance);

/** Indices of the matches within `tolerance` of `shape`, ascending. */
std::vector<std::size_t> indices_of_shape(const DominantShape& shape,
                                          const std::vector<Match>& matches,
                                          const std::vector<KeypointShape>& query,
                                          const std::vector<KeypointShape>& candidate,
                                          const ShapeTolerance& tolerance);

}  // namespace fild
