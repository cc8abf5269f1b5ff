// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/verification_options.h"

namespace fild
{
void TVerificationOptions::describe(OptionVisitor& visitor)
{
    visitor.choice<RansacMethod>("method",
                                 method,
                                 {{"ransac", RansacMethod::ransac},
                                  {"lo_ransac", RansacMethod::lo_ransac},
                                  {"graph_cut", RansacMethod::graph_cut},
                                  {"magsac", RansacMethod::magsac}});
    visitor.integer("min_inliers", min_inliers, 8, 100000);
    visitor.flag("one_shape", one_shape);
    visitor.real("max_epipolar_error_px", max_epipolar_error_px, 0.1, 100);
    visitor.real("confidence", confidence, 0.5, 0.999999);
    visitor.integer("max_iterations", max_iterations, 10, 1000000);
}

}  // namespace fild
