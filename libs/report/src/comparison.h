// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/report/html_report.h"

#include <nlohmann/json.hpp>

namespace fild
{
/** All that comparison.js shows of two runs; see write_html_comparison(). */
nlohmann::ordered_json comparison_json(const ComparedRun& first,
                                       const ComparedRun& second,
                                       const TReportOptions& options);

}  // namespace fild
