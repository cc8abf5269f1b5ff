// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/csv_fields.h"
#include "sweep_parts.h"

#include <iomanip>
#include <locale>
#include <set>
#include <sstream>

namespace fild
{
namespace
{
std::ostringstream begin_csv(const SweepReport& report)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    for (const auto& key : report.keys) out << csv_field(key) << ',';
    out << std::fixed << std::setprecision(6);
    return out;
}

void write_values(std::ostream& out, const SweepPoint& point)
{
    for (const auto& value : point.values) out << csv_field(value) << ',';
}

void write_number(std::ostream& out, double value, Metric::Kind kind)
{
    const bool whole =
        kind == Metric::Kind::count && value == static_cast<double>(static_cast<long>(value));
    out << std::setprecision(whole ? 0 : 6) << value;
}

/** Metrics of all points: one may have an undefined one that another has. */
std::vector<Metric> metrics_of(const SweepReport& report)
{
    std::vector<std::vector<Metric>> all;
    for (const auto& point : report.points)
        for (const auto& run : point.runs) all.push_back(metrics_of(run));
    std::vector<Metric> metrics;
    for (const auto& range : ranges_of(all))
        if (range.runs > 0) metrics.push_back(range.metric);
    return metrics;
}

std::set<std::string> stages_of(const SweepReport& report)
{
    std::set<std::string> stages;
    for (const auto& point : report.points)
        for (const auto& [stage, ignored] : point.times.statistics()) stages.insert(stage);
    return stages;
}

void write_times(std::ostream& out, const SweepPoint& point, const std::set<std::string>& stages)
{
    const auto statistics = point.times.statistics();
    for (const auto& stage : stages)
    {
        const auto found = statistics.find(stage);
        out << ',';
        if (found != statistics.end())
            out << std::setprecision(6) << found->second.median_ms << ',' << found->second.p95_ms;
        else
            out << ',';
    }
}
}  // namespace

std::string sweep_csv(const SweepReport& report)
{
    auto out = begin_csv(report);
    const auto metrics = metrics_of(report);
    const auto stages = stages_of(report);
    out << "runs";
    for (const auto& metric : metrics)
        out << ',' << metric.key << ',' << metric.key << "_min," << metric.key << "_max";
    for (const auto& stage : stages) out << ',' << stage << "_median_ms," << stage << "_p95_ms";
    out << '\n';
    for (const auto& point : report.points)
    {
        write_values(out, point);
        out << point.runs.size();
        const auto ranges = ranges_of(point);
        for (const auto& metric : metrics)
        {
            const auto range = find_metric(ranges, metric.key);
            out << ',';
            if (range) write_number(out, *range->metric.value, metric.kind);
            out << ',';
            if (range) write_number(out, range->min, metric.kind);
            out << ',';
            if (range) write_number(out, range->max, metric.kind);
        }
        write_times(out, point, stages);
        out << '\n';
    }
    return out.str();
}

std::string sweep_runs_csv(const SweepReport& report)
{
    auto out = begin_csv(report);
    const auto columns = metrics_of(report);
    out << "seed";
    for (const auto& column : columns) out << ',' << column.key;
    out << '\n';
    for (const auto& point : report.points)
        for (std::size_t i = 0; i < point.runs.size(); ++i)
        {
            write_values(out, point);
            out << point.seeds[i];
            const auto ranges = ranges_of({metrics_of(point.runs[i])});
            for (const auto& column : columns)
            {
                const auto value = find_metric(ranges, column.key);
                out << ',';
                if (value) write_number(out, *value->metric.value, column.kind);
            }
            out << '\n';
        }
    return out.str();
}

std::string sweep_wrong_loops_csv(const SweepReport& report)
{
    auto out = begin_csv(report);
    out << "seed,frame,candidate,similarity,matches,inliers,loop_query\n";
    for (const auto& point : report.points)
        for (std::size_t i = 0; i < point.runs.size(); ++i)
            for (const auto& [verdict, loop_query] : point.runs[i].score.wrong_loops)
            {
                write_values(out, point);
                out << point.seeds[i] << ',' << to_index(verdict.frame) << ','
                    << to_index(verdict.candidate->frame) << ',' << verdict.candidate->similarity
                    << ',' << verdict.matches << ',' << verdict.inliers << ','
                    << (loop_query ? 1 : 0) << '\n';
            }
    return out.str();
}

std::string sweep_pairs_csv(const SweepReport& report)
{
    auto out = begin_csv(report);
    out << "seed,frame,candidate,rank,matches,inliers";
    for (std::size_t k = 0; k < kEvidenceKinds; ++k)
        out << ',' << to_word(static_cast<Evidence>(k));
    out << ",against_chance,against_look_alike,truth\n";
    for (const auto& point : report.points)
        for (std::size_t i = 0; i < point.runs.size(); ++i)
            for (const auto& [query, considered, judgement] : point.runs[i].pairs)
            {
                write_values(out, point);
                out << point.seeds[i] << ',' << to_index(query) << ','
                    << to_index(considered.candidate.frame) << ',' << considered.rank << ','
                    << considered.matches << ',' << considered.inliers;
                for (const double share : considered.evidence) out << ',' << share;
                out << ',' << considered.odds->against_chance << ','
                    << considered.odds->against_look_alike << ',';
                if (judgement != Judgement::neither) out << (judgement == Judgement::right ? 1 : 0);
                out << '\n';
            }
    return out.str();
}

}  // namespace fild
