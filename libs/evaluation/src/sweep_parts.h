// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/metric.h"
#include "fild/evaluation/sweep_report.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** A metric that stands in the tables of a sweep. */
struct SweepColumn
{
    const char* key;
    const char* title;
    const char* tex;
};
constexpr std::array<SweepColumn, 6> kSweepColumns{
    {{"recall", "recall", "Recall"},
     {"precision", "precision", "Precision"},
     {"recall_at_full_precision_inliers", "recall, P = 1", "Recall at $P=1$"},
     {"segment_recall", "segments", "Segment recall"},
     {"wrong", "wrong", "Wrong"},
     {"worst_wrong_support", "worst wrong", "Worst wrong support"}}};

/** A stage whose time stands in them: median over all calls, milliseconds. */
constexpr std::array<SweepColumn, 2> kSweepTimes{
    {{"index_search", "search, ms", "Search, ms"}, {"matching", "matching, ms", "Matching, ms"}}};

/** ranges_of() the metrics of the point's runs. */
std::vector<MetricRange> ranges_of(const SweepPoint& point);

/** Of metrics as they come from ranges_of(); nothing when it is undefined. */
std::optional<MetricRange> find_metric(const std::vector<MetricRange>& ranges,
                                       const std::string& key);

/** Median time of one call; nothing when there was none. */
std::optional<double> median_ms(const SweepPoint& point, const std::string& stage);

/** Cells of the tables: the point's values, then kSweepColumns as `mean` or `mean [min, max]`, then
 *  kSweepTimes; `-` for what is undefined. */
std::vector<std::string> cells_of(const SweepPoint& point);

/** Contents of the files. */
std::string sweep_csv(const SweepReport& report);
std::string sweep_runs_csv(const SweepReport& report);
std::string sweep_wrong_loops_csv(const SweepReport& report);
std::string sweep_pairs_csv(const SweepReport& report);
std::string sweep_tex(const SweepReport& report);
std::string sweep_svg(const SweepReport& report);

}  // namespace fild
