// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/graph_options.h"

#include <sstream>
#include <stdexcept>

namespace fild
{
void TGraphOptions::describe(OptionVisitor& visitor)
{
    visitor.text("motion_sources", motion_sources);
    visitor.text("motion_sensor_label", motion_sensor_label);
    visitor.choice<OdometryCovariance>(
        "odometry_covariance",
        odometry_covariance,
        {{"own", OdometryCovariance::own}, {"model", OdometryCovariance::model}});
    visitor.real("drift_percent", drift_percent, 1e-3, 100);
    visitor.real("heading_drift_deg", heading_drift_deg, 1e-3, 180);
    visitor.real("turn_drift_percent", turn_drift_percent, 0, 100);
    visitor.real("planar_attitude_deg", planar_attitude_deg, 1e-3, 90);
    visitor.real("max_gap_s", max_gap_s, 1e-3, 1e6);
    visitor.real("max_speed_m_per_s", max_speed_m_per_s, 0.1, 1e4);
    visitor.real("gps_sigma_m", gps_sigma_m, 1e-3, 1e3);
    visitor.real("gps_differential_sigma_m", gps_differential_sigma_m, 1e-3, 1e3);
    visitor.real("gps_rtk_float_sigma_m", gps_rtk_float_sigma_m, 1e-3, 1e3);
    visitor.real("gps_rtk_sigma_m", gps_rtk_sigma_m, 1e-3, 1e3);
    visitor.real("gps_heading_baseline_m", gps_heading_baseline_m, 0.1, 1e3);
    visitor.real("keyframe_distance_m", keyframe_distance_m, 0, 1e4);
    visitor.real("keyframe_angle_deg", keyframe_angle_deg, 0, 180);
    visitor.real("keyframe_seconds", keyframe_seconds, 0, 1e6);
    visitor.flag("pairwise_consistency", pairwise_consistency);
    visitor.real("pairwise_confidence", pairwise_confidence, 0.5, 0.999999);
    visitor.real("odometry_confidence", odometry_confidence, 0.5, 1);
    visitor.flag("robust_weights", robust_weights);
    visitor.real("loop_confidence", loop_confidence, 0.5, 0.999999);
    visitor.integer("max_iterations", max_iterations, 1, 1000);
    visitor.choice<GraphDimensions>(
        "graph_dimensions",
        graph_dimensions,
        {{"2d", GraphDimensions::planar}, {"3d", GraphDimensions::spatial}});
    visitor.choice<TrajectoryFormat>(
        "trajectory_format",
        trajectory_format,
        {{"tum", TrajectoryFormat::tum}, {"kitti", TrajectoryFormat::kitti}});
    visitor.flag("simple_map", simple_map);
}

MotionSources TGraphOptions::sources() const
{
    if (motion_sources == "auto") return {};
    MotionSources sources{false, false, false};
    std::istringstream words(motion_sources);
    for (std::string word; std::getline(words, word, ',');)
    {
        word.erase(0, word.find_first_not_of(' '));
        word.erase(word.find_last_not_of(' ') + 1);
        if (word == "odometry")
            sources.odometry = true;
        else if (word == "vision")
            sources.vision = true;
        else if (word == "gps")
            sources.gps = true;
        else
            throw std::invalid_argument("motion_sources=" + motion_sources + ": '" + word +
                                        "' is not one of odometry, vision, gps; or auto alone");
    }
    return sources;
}

void TGraphOptions::check_between_fields() const
{
    const auto used = sources();
    if (!used.odometry && !used.vision && !used.gps)
        throw std::invalid_argument(
            "motion_sources names no source: auto, or some of odometry, vision, gps");
    if (keyframe_distance_m == 0 && keyframe_angle_deg == 0 && keyframe_seconds == 0)
        throw std::invalid_argument(
            "keyframe_distance_m, keyframe_angle_deg and keyframe_seconds are all 0: there would "
            "be no keyframes; set one of them");
}

}  // namespace fild
