// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/metric.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace fild
{
namespace
{
using Kind = Metric::Kind;

std::string without_zeros(double number)
{
    std::ostringstream text;
    text << number;
    return text.str();
}

/** Collects metrics under headlines. */
class MetricList
{
 public:
    void group(std::string headline) { group_ = std::move(headline); }

    void count(const std::string& key,
               const std::string& name,
               std::size_t value,
               const std::string& meaning = "")
    {
        add({group_, key, name, meaning, Kind::count, static_cast<double>(value), false});
    }

    void share(const std::string& key,
               const std::string& name,
               std::optional<double> value,
               const std::string& meaning)
    {
        add({group_, key, name, meaning, Kind::share, value, false});
    }

    void measure(const std::string& key,
                 const std::string& name,
                 std::optional<double> value,
                 const std::string& meaning)
    {
        add({group_, key, name, meaning, Kind::measure, value, false});
    }

    /** For a metric whose input may be missing. */
    void optional(const std::string& key,
                  const std::string& name,
                  Kind kind,
                  std::optional<double> value,
                  const std::string& meaning)
    {
        add({group_, key, name, meaning, kind, value, true});
    }

    std::vector<Metric> take() { return std::move(metrics_); }

 private:
    void add(Metric metric) { metrics_.push_back(std::move(metric)); }

    std::string group_;
    std::vector<Metric> metrics_;
};

void add_counts(MetricList& list, const LoopScore& score)
{
    list.count("loop_queries", "loop queries", score.loop_queries, "frames with a true loop");
    list.count("accepted", "accepted", score.accepted, "loop closures");
    list.count("right", "  right", score.right);
    list.count("wrong", "  wrong", score.wrong_loops.size());
    list.count("neither", "  neither", score.neither, "left out of precision");
    list.count("missed", "missed", score.missed(), "loop queries without a right answer");
    list.share("precision", "precision", score.precision(), "right / (right + wrong)");
    list.share("recall", "recall", score.recall(), "right / loop queries");
}

void add_stretches(MetricList& list, const std::vector<LoopStretch>& stretches)
{
    list.count("stretches",
               "stretches",
               stretches.size(),
               "rows of loop queries, gaps up to " + std::to_string(kMaxStretchGap) + " frames");
    list.count("stretches_found",
               "  found",
               count_found(stretches),
               "of " + std::to_string(stretches.size()) + ", with a right loop closure");
    list.share("segment_recall", "segment recall", segment_recall(stretches), "found / stretches");
}

void add_curve(MetricList& list, const PrecisionRecallCurve& curve)
{
    const auto kind = to_word(curve.kind);
    const auto threshold_kind = curve.kind == ScoreKind::inliers ? Kind::count : Kind::measure;
    const auto threshold_of = [](const std::optional<CurvePoint>& point)
    { return point ? std::optional(point->threshold) : std::nullopt; };
    const auto best = curve.at_max_f1();
    list.group("by " + kind + ": if all candidates from a threshold up were accepted");
    list.share("recall_at_full_precision_" + kind,
               "  recall, P = 1",
               curve.recall_at_full_precision(),
               "the greatest before the first wrong one");
    list.optional("threshold_at_full_precision_" + kind,
                  "  from",
                  threshold_kind,
                  threshold_of(curve.at_full_precision()),
                  kind + " up");
    list.share(
        "max_f1_" + kind, "  maximum F1", best ? best->f1() : std::nullopt, "2 P R / (P + R)");
    list.optional(
        "threshold_at_max_f1_" + kind, "  from", threshold_kind, threshold_of(best), kind + " up");
    list.share("average_precision_" + kind,
               "  average P",
               curve.average_precision(),
               "average precision: sum of P times gain in R");
    list.group("");
}

void add_worst_wrong(MetricList& list, const std::optional<WorstWrongPair>& worst)
{
    list.optional("worst_wrong_support",
                  "worst wrong",
                  Kind::measure,
                  worst ? std::optional(worst->support) : std::nullopt,
                  "greatest support of a wrong candidate, accepted or not");
    list.optional("worst_wrong_inliers",
                  "  inliers",
                  Kind::count,
                  worst ? std::optional(static_cast<double>(worst->inliers)) : std::nullopt,
                  "of the same");
}

void add_candidates(MetricList& list, const std::optional<CandidateEvaluation>& candidates)
{
    list.group("candidate recall: a true place is among the first answers of the index");
    for (std::size_t i = 0; i < kCandidateRanks.size(); ++i)
    {
        const auto rank = std::to_string(kCandidateRanks.at(i));
        list.optional("candidate_recall_" + rank,
                      "  at " + rank,
                      Kind::share,
                      candidates ? candidates->recall.at(i) : std::nullopt,
                      "of the loop queries");
    }
    list.group("missed loop queries, by the stage that lost them");
    for (const auto stage : kLossStages)
    {
        std::optional<double> lost;
        if (candidates)
            lost = static_cast<double>(std::count_if(candidates->lost.begin(),
                                                     candidates->lost.end(),
                                                     [&](const LostLoop& loop)
                                                     { return loop.stage == stage; }));
        list.optional(
            "lost_" + to_word(stage), "  " + to_word(stage), Kind::count, lost, meaning_of(stage));
    }
}

void add_steps(MetricList& list, const NamedTrajectoryError& trajectory)
{
    for (const auto& step : trajectory.error.steps)
    {
        const auto length = without_zeros(step.length) + "m";
        const auto key = "rpe_" + trajectory.name + "_" + length + "_";
        const auto name = "  RPE " + length;
        list.optional(key + "m", name, Kind::measure, step.translation_rmse, "m, RMSE");
        list.optional(
            key + "percent", name, Kind::measure, step.translation_percent, "% of the way, mean");
        list.optional(
            key + "deg_per_m", name, Kind::measure, step.rotation_deg_per_m, "deg/m, mean");
    }
}

void add_trajectory(MetricList& list,
                    const std::string& name,
                    const std::optional<NamedTrajectoryError>& trajectory)
{
    list.group("trajectory '" + name + "' against the truth");
    const auto value = [&](auto member) -> std::optional<double>
    {
        if (!trajectory) return std::nullopt;
        return static_cast<double>(trajectory->error.*member);
    };
    list.optional("ate_" + name + "_poses",
                  "  poses",
                  Kind::count,
                  value(&TrajectoryError::pairs),
                  "compared");
    list.optional("ate_" + name + "_m",
                  "  ATE",
                  Kind::measure,
                  value(&TrajectoryError::ate_rmse),
                  "m, RMSE after alignment");
    list.optional("ate_" + name + "_scale",
                  "  scale",
                  Kind::measure,
                  value(&TrajectoryError::scale),
                  "of the alignment");
    if (trajectory) add_steps(list, *trajectory);
}

void add_trajectories(MetricList& list, const std::vector<NamedTrajectoryError>& trajectories)
{
    const auto find = [&](const std::string& name) -> std::optional<NamedTrajectoryError>
    {
        for (const auto& trajectory : trajectories)
            if (trajectory.name == name) return trajectory;
        return std::nullopt;
    };
    for (const std::string name : {"input", "optimized"}) add_trajectory(list, name, find(name));
    for (const auto& trajectory : trajectories)
        if (trajectory.name != "input" && trajectory.name != "optimized")
            add_trajectory(list, trajectory.name, trajectory);
}
}  // namespace

std::vector<Metric> metrics_of(const RunEvaluation& run)
{
    MetricList list;
    add_counts(list, run.score);
    add_stretches(list, run.stretches);
    add_worst_wrong(list, run.worst_wrong);
    add_curve(list, run.inlier_curve);
    add_curve(list, run.similarity_curve);
    add_candidates(list, run.candidates);
    add_trajectories(list, run.trajectories);
    return list.take();
}

std::vector<MetricRange> ranges_of(const std::vector<std::vector<Metric>>& runs)
{
    std::vector<MetricRange> ranges;
    const auto range_of = [&](const Metric& metric) -> MetricRange&
    {
        for (auto& range : ranges)
            if (range.metric.key == metric.key) return range;
        ranges.push_back({metric, 0, 0, 0});
        ranges.back().metric.value.reset();
        return ranges.back();
    };
    for (const auto& run : runs)
        for (const auto& metric : run)
        {
            auto& range = range_of(metric);
            if (!metric.value) continue;
            const double value = *metric.value;
            range.min = range.runs == 0 ? value : std::min(range.min, value);
            range.max = range.runs == 0 ? value : std::max(range.max, value);
            ++range.runs;
            const double mean = range.metric.value.value_or(0);
            range.metric.value = mean + (value - mean) / static_cast<double>(range.runs);
        }
    return ranges;
}

std::string format_value(double value, Metric::Kind kind)
{
    std::ostringstream text;
    text << std::fixed;
    if (kind == Metric::Kind::share && value > 0 && value < 1)
        value = std::clamp(value, 0.001, 0.999);
    if (kind == Metric::Kind::count)
        text << std::setprecision(value == std::floor(value) ? 0 : 1) << value;
    else
        text << std::setprecision(3) << value;
    return text.str();
}

std::string format_range(const MetricRange& range, bool several)
{
    if (range.runs == 0) return "-";
    const auto kind = range.metric.kind;
    auto mean = format_value(*range.metric.value, kind);
    if (!several) return mean;
    return mean + " [" + format_value(range.min, kind) + ", " + format_value(range.max, kind) + "]";
}

}  // namespace fild
