// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** Where the scale of a frame comes from. */
enum class DepthSource
{
    none,  ///< there is no scale
    stereo,  ///< a right image
    depth_image,  ///< a depth camera
    motion  ///< an earlier frame of the same camera and the odometry between them
};

/** The enumerator's name, `none` included. */
std::string to_word(DepthSource source);

/** Depths of a frame's keypoints, in their order. Value type. */
struct KeypointDepths
{
    DepthSource source = DepthSource::none;
    /** Metres along the optical axis of the frame's camera, one a keypoint; NaN: unknown. Empty
     * when the source is none. */
    std::vector<float> metres;
    /** Standard deviation of each, metres; NaN where the depth is. Kept beside the depth because it
     *  follows from no formula of it: of two points equally far, the one with the sharper patch or
     *  the larger parallax is known better. */
    std::vector<float> deviations_m;
    /** Standard deviation of a factor that all depths share: that of the odometry's length. */
    double scale_deviation = 0;

    std::size_t known() const;  ///< how many depths there are
};

/** What the frame itself can give: stereo, depth_image or none. */
DepthSource depth_source_of(const Frame& frame);

}  // namespace fild
