// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/report/html_report.h"
#include "fild/run/truth.h"

#include <optional>
#include <string>

namespace fild
{
/** What the ground truth says of the run whose results are in the folder.
 *  \param delay_seconds  of the run, see for_run(); nothing: as its summary.json says.
 *  \throw std::runtime_error, std::invalid_argument as read_run() and load_truth(). */
ReportTruth judge_run(const std::string& folder,
                      const TruthOptions& options,
                      std::optional<double> delay_seconds = std::nullopt);

}  // namespace fild
