// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** Section [depth]: how far keypoints are away, from a stereo pair, a depth image or motion. */
struct TDepthOptions : Options
{
    double min_depth_m = 0.3;  ///< nearer points are unknown: bounds the search for disparities
    /** Points whose depth has a larger relative standard deviation are unknown. */
    double max_relative_deviation = 0.1;

    // Stereo.
    double max_row_error_px = 2;  ///< of matched keypoints of a rectified pair
    double stereo_ratio = 0.9;  ///< nearest code against second nearest on the epipolar line
    int patch_px = 11;  ///< side of the patches that are compared to a part of a pixel; odd
    double min_correlation = 0.8;  ///< of the patches, [-1, 1]
    double disparity_deviation_px = 0.1;  ///< standard deviation at best; weak texture adds to it

    // Depth image.
    /** Depths about a keypoint that differ by a larger share, or so much from a plane, are an edge.
     */
    double max_step = 0.05;
    /** Standard deviation: this, plus the second times the squared depth, which is how disparity
     *  sensors err: K. Khoshelham, S. Oude Elberink, "Accuracy and Resolution of Kinect Depth
     * Data", Sensors 12 (2012), eq. (10). Distances measured by light's time of flight err less. */
    double sensor_deviation_m = 0.002;
    double sensor_deviation_per_m2 = 0.0014;

    // Motion.
    double min_baseline_m = 0.2;  ///< between the two frames
    double min_parallax_deg = 1;  ///< between the two rays to a point
    double max_reprojection_px = 2;  ///< of a triangulated point
    double pixel_deviation_px = 0.7;  ///< of a keypoint's position, in each direction
    /** Odometry and images must agree on the direction of the motion up to this angle. */
    double max_direction_error_deg = 20;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
