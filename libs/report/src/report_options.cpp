// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/report_options.h"

namespace fild
{
void TReportOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("write_html", write_html);
    visitor.integer("max_pictures", max_pictures, 0, 100000);
    visitor.integer("picture_width_px", picture_width_px, 100, 10000);
    visitor.integer("max_rejected_pictures", max_rejected_pictures, 0, 100000);
    visitor.integer("similarity_frames", similarity_frames, 0, 10000);
}

}  // namespace fild
