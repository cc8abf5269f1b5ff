// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** Section [relative_pose]: when the matches of two images and their depths make a metric pose. */
struct TRelativePoseOptions : Options
{
    /** Find depths of keypoints and metric poses of loops; false: loops alone, which saves the time
     *  of right and depth images. */
    bool enabled = true;
    int min_points = 12;  ///< metric inliers; fewer are no pose
    /** Metric inliers must be this share of the verified matches that have a depth: matches that
     *  agree with a fundamental matrix but not with one pose speak of a wrong depth or place. */
    double min_inlier_share = 0.6;
    double max_reprojection_px = 3;  ///< RANSAC: of a point that agrees with a pose
    double confidence = 0.999;  ///< RANSAC stops when a better pose is this unlikely
    int max_iterations = 2000;  ///< of RANSAC
    /** Larger standard deviations along or about any axis are no pose: the points are too far, too
     *  few or on a line. */
    double max_position_deviation_m = 1;
    double max_rotation_deviation_deg = 2;

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
