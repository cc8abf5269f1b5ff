// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/local_feature_options.h"

namespace fild
{
void TLocalFeatureOptions::describe(OptionVisitor& visitor)
{
    visitor.real("hessian_threshold", hessian_threshold, 0, 1e6);
    visitor.integer("octaves", octaves, 1, 6);
    visitor.integer("layers_per_octave", layers_per_octave, 1, 5);
    visitor.flag("upright", upright);
    visitor.integer("min_keypoints", min_keypoints, 0, 1000000);
    visitor.integer("max_keypoints", max_keypoints, 0, 1000000);
}

void TLocalFeatureOptions::check_between_fields() const
{
    if (max_keypoints > 0 && min_keypoints > max_keypoints)
        throw std::invalid_argument("min_keypoints=" + std::to_string(min_keypoints) +
                                    " is above max_keypoints=" + std::to_string(max_keypoints));
}

}  // namespace fild
