// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/depth_options.h"

namespace fild
{
void TDepthOptions::describe(OptionVisitor& visitor)
{
    visitor.real("min_depth_m", min_depth_m, 0.01, 100);
    visitor.real("max_relative_deviation", max_relative_deviation, 0.001, 1);
    visitor.real("max_row_error_px", max_row_error_px, 0.1, 20);
    visitor.real("stereo_ratio", stereo_ratio, 0.01, 1);
    visitor.integer("patch_px", patch_px, 5, 31);
    visitor.real("min_correlation", min_correlation, -1, 1);
    visitor.real("disparity_deviation_px", disparity_deviation_px, 0.01, 5);
    visitor.real("max_step", max_step, 0.001, 1);
    visitor.real("sensor_deviation_m", sensor_deviation_m, 0.0001, 1);
    visitor.real("sensor_deviation_per_m2", sensor_deviation_per_m2, 0, 1);
    visitor.real("min_baseline_m", min_baseline_m, 0.001, 100);
    visitor.real("min_parallax_deg", min_parallax_deg, 0.01, 90);
    visitor.real("max_reprojection_px", max_reprojection_px, 0.1, 20);
    visitor.real("pixel_deviation_px", pixel_deviation_px, 0.05, 10);
    visitor.real("max_direction_error_deg", max_direction_error_deg, 0.1, 90);
}

void TDepthOptions::check_between_fields() const
{
    if (patch_px % 2 == 0)
        throw std::invalid_argument("patch_px=" + std::to_string(patch_px) + " is not odd");
}

}  // namespace fild
