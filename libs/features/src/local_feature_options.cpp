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
    visitor.integer("max_keypoints", max_keypoints, 0, 1000000);
}

}  // namespace fild
