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
    /** Weighed inliers must be at least so many. Seven matches fit some fundamental matrix whatever
     *  they are, so they count nothing, and a wrong pair with many matches gathers inliers by
     *  chance, but not most of its matches. Of m matches, i inliers weigh
     *  (i - 7) * ((i - 7) / (m - 7))^2. Wrong pairs reached 15 inliers of 28 matches in an office
     *  corridor and 23 of 49 on KITTI 03, which weigh 1.2 and 2.3; 22 of 28, of a true one,
     * weigh 7.7. 0: not asked, as in the paper. */
    double min_weighed_inliers = 0;
    /** ... and at least this share of the keypoints beyond sparse_keypoints, of whichever image has
     *  fewer: in an image full of texture one house that looks like another gives many inliers, 78
     * of 109 matches on the synthetic town, yet few of 2,100 keypoints. 0: not asked, as in the
     * paper.
     */
    double min_weighed_inlier_share = 0;
    int sparse_keypoints = 0;  ///< what an image with hardly any texture has
    double max_epipolar_error_px = 3;  ///< a match is an inlier up to this distance, pixels
    double confidence = 0.99;  ///< RANSAC stops when a better model is this unlikely
    int max_iterations = 1000;

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
