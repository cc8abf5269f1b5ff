// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/run_evaluation.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** One number about a run, and how it is shown. */
struct Metric
{
    enum class Kind
    {
        count,  ///< whole number
        share,  ///< in [0, 1]
        measure  ///< any real number
    };

    std::string group;  ///< headline that it stands under; empty: none
    std::string key;  ///< in files: "max_f1_inliers"
    std::string name;  ///< for a person, short
    std::string meaning;  ///< for a person, a phrase
    Kind kind = Kind::count;
    std::optional<double> value;  ///< none: undefined, or what it is made from is not there
    /** Its input may be missing: then it is left out of texts; else undefined is shown as such. */
    bool left_out_without_value = false;
};

/** All numbers about a run, in the order of the report. The keys do not depend on the run, except
 *  those of trajectories. */
std::vector<Metric> metrics_of(const RunEvaluation& run);

/** A metric over several runs. */
struct MetricRange
{
    Metric metric;  ///< its value is the mean
    double min = 0;
    double max = 0;
    std::size_t runs = 0;  ///< that have a value; with none, mean, min and max say nothing
};

/** Mean, least and greatest value of each metric over the runs that have it.
 *  \param runs  metrics_of() each. */
std::vector<MetricRange> ranges_of(const std::vector<std::vector<Metric>>& runs);

/** A value as text: whole counts without decimals, others with three (of a mean count: one). Of
 *  shares only what is perfect reads 1.000, and only what is nothing 0.000. */
std::string format_value(double value, Metric::Kind kind);

/** The mean, with the least and the greatest value if there are several runs: `0.5 [0.4, 0.6]`; `-`
 *  without any value. */
std::string format_range(const MetricRange& range, bool several);

}  // namespace fild
