// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** What counts as a local feature of an image: section `[local_features]` of the .ini file. */
struct TLocalFeatureOptions : Options
{
    /** Smallest determinant of the Hessian that makes a keypoint, [0, 1e6]: the contrast asked for.
     *  Doubling the contrast of an image multiplies determinants by 4. The scale is set so that 100
     *  finds about as many keypoints as it does in other SURF implementations: 2,050 in a 1024x768
     *  picture of a car park. */
    double hessian_threshold = 100;
    /** Octaves of the scale space, [1, 6]. Each doubles the largest mask (27, 51, 99, 195 pixels
     * with 2 layers) and the sampling step. */
    int octaves = 4;
    /** Scales of an octave in which keypoints are looked for, [1, 5]; the paper's 4 masks an octave
     *  are 2 of these, with one neighbour below and one above. */
    int layers_per_octave = 2;
    /** U-SURF: no orientation is sought, every angle is 0. Quicker, and more distinctive for a
     *  camera that never rolls by more than some 15 degrees. */
    bool upright = false;
    /** An image with fewer keypoints is searched again down to a tenth of hessian_threshold, and
     * the strongest so many are kept: a blank wall, a dark corner. 0: it is not, as in the paper.
     */
    int min_keypoints = 0;
    /** At most so many keypoints an image, those with the largest determinant; 0: all. */
    int max_keypoints = 0;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
