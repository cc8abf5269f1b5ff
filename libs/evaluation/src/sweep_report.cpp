// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/sweep_report.h"

#include "evaluation_parts.h"
#include "fild/core/whole_file.h"
#include "fild/core/words.h"
#include "sweep_parts.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace fild
{
namespace
{
/** Rows of cells, each column as wide as its widest cell. */
std::string aligned(const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::ostringstream text;
    for (const auto& row : rows)
    {
        for (std::size_t i = 0; i < row.size(); ++i)
            text << (i == 0 ? "" : "  ") << std::right << std::setw(static_cast<int>(widths[i]))
                 << row[i];
        text << '\n';
    }
    return text.str();
}

std::string headline_of(const SweepReport& report)
{
    std::ostringstream text;
    text << "recording     " << report.rawlog << '\n';
    for (const auto& remark : report.remarks) text << "              " << remark << '\n';
    text << "configuration " << report.config << (report.overrides.empty() ? "" : " with ")
         << joined(report.overrides, " ") << "\nground truth  " << report.truth.file << ": "
         << report.truth.content << '\n';
    for (const auto& remark : report.truth.remarks) text << "              " << remark << '\n';
    text << "protocol      " << to_word(report.truth.protocol) << ": "
         << rule_of(report.truth.protocol) << '\n';
    return text.str();
}

std::string table_of(const SweepReport& report)
{
    std::vector<std::vector<std::string>> rows{report.keys};
    for (const auto& column : kSweepColumns) rows.front().emplace_back(column.title);
    for (const auto& column : kSweepTimes) rows.front().emplace_back(column.title);
    for (const auto& point : report.points) rows.push_back(cells_of(point));
    return aligned(rows);
}

std::string remark_on_table(const SweepReport& report)
{
    const auto runs = report.points.front().runs.size();
    std::string text;
    if (runs > 1) text = "mean [min, max] over " + std::to_string(runs) + " seeds; ";
    return text + "times: median of a search, and of matching one candidate\n";
}

std::vector<std::string> lines_of_wrong_loops(const SweepPoint& point)
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < point.runs.size(); ++i)
        for (const auto& wrong : point.runs[i].score.wrong_loops)
            lines.push_back("wrong  " + joined(point.values, " ") +
                            (point.values.empty() ? "" : ", ") + "seed " +
                            std::to_string(point.seeds[i]) + ": frame " +
                            std::to_string(to_index(wrong.verdict.frame)) + " at frame " +
                            std::to_string(to_index(wrong.verdict.candidate->frame)) + ", " +
                            std::to_string(wrong.verdict.inliers) + " inliers");
    return lines;
}
}  // namespace

std::vector<MetricRange> ranges_of(const SweepPoint& point)
{
    std::vector<std::vector<Metric>> metrics;
    metrics.reserve(point.runs.size());
    for (const auto& run : point.runs) metrics.push_back(metrics_of(run));
    return ranges_of(metrics);
}

std::optional<MetricRange> find_metric(const std::vector<MetricRange>& ranges,
                                       const std::string& key)
{
    for (const auto& range : ranges)
        if (range.metric.key == key && range.runs > 0) return range;
    return std::nullopt;
}

std::optional<double> median_ms(const SweepPoint& point, const std::string& stage)
{
    const auto statistics = point.times.statistics();
    const auto found = statistics.find(stage);
    if (found == statistics.end()) return std::nullopt;
    return found->second.median_ms;
}

std::vector<std::string> cells_of(const SweepPoint& point)
{
    auto cells = point.values;
    const auto ranges = ranges_of(point);
    for (const auto& column : kSweepColumns)
    {
        const auto range = find_metric(ranges, column.key);
        cells.push_back(range ? format_range(*range, point.runs.size() > 1) : "-");
    }
    for (const auto& column : kSweepTimes)
    {
        const auto time = median_ms(point, column.key);
        cells.push_back(time ? format_value(*time, Metric::Kind::measure) : "-");
    }
    return cells;
}

std::string to_text(const SweepReport& report, std::size_t max_wrong)
{
    auto text = headline_of(report);
    if (report.points.empty()) return text + "no point was run to its end\n";
    text += table_of(report) + remark_on_table(report);
    std::vector<std::string> wrong;
    for (const auto& point : report.points)
        for (auto& line : lines_of_wrong_loops(point)) wrong.push_back(std::move(line));
    for (std::size_t i = 0; i < std::min(wrong.size(), max_wrong); ++i) text += wrong[i] + "\n";
    if (wrong.size() > max_wrong)
        text += "       and " + std::to_string(wrong.size() - max_wrong) + " more\n";
    return text;
}

void write_sweep(const SweepReport& report, const std::string& folder)
{
    const auto path = make_folder(folder);
    write_whole_file(path / "sweep_runs.csv", sweep_runs_csv(report));
    write_whole_file(path / "sweep_wrong_loops.csv", sweep_wrong_loops_csv(report));
    write_whole_file(path / "sweep_pairs.csv", sweep_pairs_csv(report));
    write_whole_file(path / "sweep.tex", sweep_tex(report));
    write_whole_file(path / "sweep.svg", sweep_svg(report));
    write_whole_file(path / "sweep.csv", sweep_csv(report));
}

}  // namespace fild
