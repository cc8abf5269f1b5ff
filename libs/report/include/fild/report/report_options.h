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
    int picture_width_px = 700;  ///< wider pictures are scaled down
    /** Rejected pairs with a match picture, those with most support; 0: none. */
    int max_rejected_pictures = 20;
    /** Frames, evenly over the run, in the matrix of similarities; at least half as many when there
     *  are more. 0: no matrix. Its cost grows with the square. */
    int similarity_frames = 500;

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
