// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/frame.h"

#include <cmath>

namespace fild
{
std::string to_word(DepthDefect defect)
{
    switch (defect)
    {
        case DepthDefect::none:
            return "";
        case DepthDefect::mono:
            return "mono";
        case DepthDefect::not_calibrated:
            return "not_calibrated";
        case DepthDefect::distorted:
            return "distorted";
        case DepthDefect::missing_right_image:
            return "missing_right_image";
        case DepthDefect::unusable_baseline:
            return "unusable_baseline";
        case DepthDefect::missing_depth_image:
            return "missing_depth_image";
    }
    return "";
}

bool is_usable_baseline(const RigidTransform& left_from_right)
{
    constexpr double kShortest = 1e-3;  // metres
    constexpr double kSine30 = 0.5;
    const auto& baseline = left_from_right.translation;
    const double length = cv::norm(baseline);
    if (!std::isfinite(length) || length < kShortest) return false;
    const double beside = std::hypot(baseline[0], baseline[1]);
    return beside >= kSine30 * length && baseline[0] >= -kSine30 * beside;
}

}  // namespace fild
