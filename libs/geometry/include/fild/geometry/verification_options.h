// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** Robust estimators of the fundamental matrix; each is OpenCV's USAC framework with the sampling,
 *  scoring and local optimisation that the name stands for. */
enum class RansacMethod
{
    ransac,  ///< uniform sampling, counts inliers, no local optimisation: the paper's
    lo_ransac,  ///< the same with inner local optimisation
    graph_cut,  ///< GC-RANSAC
    magsac  ///< MAGSAC++: marginalises over the inlier threshold
};

/** Section [verification]: when the matches of two images count as one scene seen twice. */
struct TVerificationOptions : Options
{
    RansacMethod method = RansacMethod::ransac;
    int min_inliers = 20;  ///< tau: fewer inliers are no loop
    /** Only matches near the rotation and scale that most of them have, within 30 degrees and one
     *  octave, are tried for a fundamental matrix; wrong matches have random ones. Not in the
     *  paper. */
    bool one_shape = false;
    double max_epipolar_error_px = 3;  ///< a match is an inlier up to this distance, pixels
    double confidence = 0.99;  ///< RANSAC stops when a better model is this unlikely
    int max_iterations = 1000;

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
