// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

#include <string>

namespace fild
{
/** Which sources of the robot's motion are used. Value type. */
struct MotionSources
{
    bool odometry = true;  ///< CObservationOdometry, CObservationRobotPose, or a rawlog's actions
    bool vision = true;  ///< stereo pairs and depth images
    bool gps = true;  ///< CObservationGPS with GGA messages
};

/** How certain the odometry is said to be. */
enum class OdometryCovariance
{
    own,  ///< the observation's where it carries one, else the model
    model  ///< always the model
};

/** What poses.graph holds. */
enum class GraphDimensions
{
    planar,  ///< for graph-slam --2d
    spatial  ///< for graph-slam --3d
};

/** Format of the trajectory files. */
enum class TrajectoryFormat
{
    tum,  ///< seconds x y z qx qy qz qw
    kitti  ///< the 12 numbers of a 3x4 matrix, row by row, a line for each frame
};

/** Section `[graph]`: from odometry and loop closures to an optimised map. */
struct TGraphOptions : Options
{
    /** `auto`, all that there are, or some of odometry, vision and gps, separated by commas. */
    std::string motion_sources = "auto";
    /** Label of the odometry to use. Empty: the first. */
    std::string motion_sensor_label;

    /** The model unless the recording's own are known to be good: those of actions mostly come from
     *  MRPT's motion model as it is preset, 3 degrees of heading after 2.5 m, and an odometry that
     *  is that uncertain contradicts no false loop. */
    OdometryCovariance odometry_covariance = OdometryCovariance::model;
    /** Model: standard deviation of the position after 100 m, in percent of them; it grows with
     *  the square root of the way, as independent errors do. */
    double drift_percent = 1;
    /** Model: standard deviation of the heading after 100 m straight on; grows likewise. */
    double heading_drift_deg = 1;
    /** Model: standard deviation of the heading after turning by 90 degrees, in percent of them;
     *  grows with the square root of the angle. */
    double turn_drift_percent = 1;
    /** What a planar odometry, or GPS, does not see: standard deviation of the pitch and of the
     *  roll between two frames, however far apart. */
    double planar_attitude_deg = 0.5;
    /** Longest time without a reading over which poses are interpolated, seconds. */
    double max_gap_s = 2;
    /** Two readings further apart than this speed allows are a reset of the odometry, GPS fixes
     *  that are so are left out, and so are motions that the images tell. */
    double max_speed_m_per_s = 60;
    /** GPS: standard deviation of a horizontal position at HDOP 1, metres, by the quality that its
     *  GGA message tells. Heights are twice as uncertain. */
    double gps_sigma_m = 2;
    double gps_differential_sigma_m = 0.8;
    double gps_rtk_float_sigma_m = 0.3;
    double gps_rtk_sigma_m = 0.03;  ///< fixed
    /** GPS: the heading is that of a movement of at least so many metres, of half as many at the
     *  ends of the drive. */
    double gps_heading_baseline_m = 10;

    /** A frame becomes a keyframe so far from the keyframe before, or turned by so much, or after
     *  so long; 0: not for this reason. */
    double keyframe_distance_m = 1;
    double keyframe_angle_deg = 15;
    double keyframe_seconds = 0;

    /** Leave only the largest set of loops that agree with each other (PCM). */
    bool pairwise_consistency = true;
    /** Two loops agree when their cycle's error is within this quantile of chi2 with 6 degrees of
     *  freedom. Near 1, for of N right loops each is compared N - 1 times. */
    double pairwise_confidence = 0.99999;
    /** Before that, loops are left out whose cycle with the odometry alone is beyond this quantile;
     *  1: none. */
    double odometry_confidence = 0.9999;
    /** Weigh the loops down that the rest of the graph contradicts (GNC). */
    bool robust_weights = true;
    /** A loop is fully trusted within this quantile of chi2 with 6 degrees of freedom. */
    double loop_confidence = 0.999;
    int max_iterations = 50;  ///< of one optimisation; a robust one has some 30 of them

    GraphDimensions graph_dimensions = GraphDimensions::spatial;
    TrajectoryFormat trajectory_format = TrajectoryFormat::tum;
    /** Write the keyframes with their observations. */
    bool simple_map = true;

    /** What motion_sources says. \throw std::invalid_argument naming the word that is not one. */
    MotionSources sources() const;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
