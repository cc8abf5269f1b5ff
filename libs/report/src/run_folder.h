// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/report/html_report.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fild
{
/** All that report.js shows, as it expects it; see html_report.h. */
nlohmann::ordered_json read_run_folder(const std::string& folder,
                                       const TReportOptions& options,
                                       const std::optional<ReportTruth>& truth);

}  // namespace fild
