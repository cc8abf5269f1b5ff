// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/relative_pose_options.h"

namespace fild
{
void TRelativePoseOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("enabled", enabled);
    visitor.integer("min_points", min_points, 6, 100000);
    visitor.real("min_inlier_share", min_inlier_share, 0, 1);
    visitor.real("max_reprojection_px", max_reprojection_px, 0.1, 50);
    visitor.real("confidence", confidence, 0.5, 0.999999);
    visitor.integer("max_iterations", max_iterations, 10, 1000000);
    visitor.real("max_position_deviation_m", max_position_deviation_m, 0.001, 1000);
    visitor.real("max_rotation_deviation_deg", max_rotation_deviation_deg, 0.01, 180);
}

}  // namespace fild
