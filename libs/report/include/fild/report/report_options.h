// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** Section [report]. */
struct TReportOptions : Options
{
    bool write_html = true;  ///< report.html
    /** Pictures of pairs in report.html; each takes some 60 kB. Beyond that, evenly over the run.
     */
    int max_pictures = 150;
    int picture_width_px = 800;  ///< wider pictures are scaled down

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
