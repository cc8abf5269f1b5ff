// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/keypoint_depths.h"

#include <algorithm>

namespace fild
{
std::string to_word(DepthSource source)
{
    switch (source)
    {
        case DepthSource::none:
            return "none";
        case DepthSource::stereo:
            return "stereo";
        case DepthSource::depth_image:
            return "depth_image";
        case DepthSource::motion:
            return "motion";
    }
    return "";
}

std::size_t KeypointDepths::known() const
{
    return static_cast<std::size_t>(
        std::count_if(metres.begin(), metres.end(), [](float z) { return z > 0; }));
}

DepthSource depth_source_of(const Frame& frame)
{
    if (!frame.camera) return DepthSource::none;
    if (frame.right) return DepthSource::stereo;
    return frame.depth.empty() ? DepthSource::none : DepthSource::depth_image;
}

}  // namespace fild
