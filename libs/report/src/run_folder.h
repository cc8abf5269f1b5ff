// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/report/html_report.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** What every run leaves in its folder. */
struct RunFolder
{
    std::string path;
    nlohmann::ordered_json summary;
    std::vector<FrameVerdict> frames;
};

/** \throw std::runtime_error naming the file that is missing, cut off or not of a run. */
RunFolder read_run_folder(const std::string& path);

/** All that the pages show of a run beside its pictures, as their scripts expect it. A trajectory
 *  is laid over the true one, when there is one.
 *  \param page  which frames are in it; the numbers count all.
 *  \throw std::runtime_error naming the file that is cut off or not of this run. */
nlohmann::ordered_json run_json(const RunFolder& run,
                                const std::optional<ReportTruth>& truth,
                                const std::vector<bool>& page);

}  // namespace fild
