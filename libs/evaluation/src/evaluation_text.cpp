// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"
#include "fild/core/words.h"
#include "fild/evaluation/evaluation_report.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <utility>

namespace fild
{
namespace
{
constexpr int kNameWidth = 16;

/** A name, a value right under the others, and what it means. */
class AlignedLines
{
 public:
    explicit AlignedLines(std::size_t value_width) : value_width_(static_cast<int>(value_width)) {}

    void words(const std::string& name, const std::string& value)
    {
        text_ << std::left << std::setw(kNameWidth) << name << value << '\n';
    }

    void value(const std::string& name, const std::string& value, const std::string& meaning)
    {
        text_ << std::left << std::setw(kNameWidth) << name << std::right << std::setw(value_width_)
              << value << (meaning.empty() ? "" : "  ") << meaning << '\n';
    }

    void headline(const std::string& line) { text_ << line << '\n'; }

    std::string text() const { return text_.str(); }

 private:
    std::ostringstream text_;
    int value_width_;
};

/** The metrics that are shown: all but those whose input is missing. */
std::vector<MetricRange> shown(std::vector<MetricRange> ranges)
{
    const auto is_left_out = [](const MetricRange& range)
    { return range.runs == 0 && range.metric.left_out_without_value; };
    ranges.erase(std::remove_if(ranges.begin(), ranges.end(), is_left_out), ranges.end());
    return ranges;
}

void add_origin(AlignedLines& lines, const EvaluationReport& report)
{
    const auto& runs = report.runs;
    const auto frames = count_of(runs.front().score.frames, "frame");
    if (runs.size() == 1) lines.words("run", runs.front().folder + ", " + frames);
    for (std::size_t i = 0; runs.size() > 1 && i < runs.size(); ++i)
        lines.words("run " + std::to_string(i + 1), runs[i].folder + (i == 0 ? ", " + frames : ""));
    for (const auto& remark : report.run_remarks) lines.words("", remark);
    lines.words("ground truth", report.truth.file + ": " + report.truth.content);
    for (const auto& remark : report.truth.remarks) lines.words("", remark);
    lines.words("protocol", to_word(report.truth.protocol) + ": " + rule_of(report.truth.protocol));
}

void add_metrics(AlignedLines& lines, const std::vector<MetricRange>& ranges, bool several)
{
    std::string group;
    for (const auto& range : ranges)
    {
        const auto& metric = range.metric;
        if (metric.group != group && !metric.group.empty()) lines.headline(metric.group);
        group = metric.group;
        lines.value(metric.name, format_range(range, several), metric.meaning);
    }
}

/** One row a run, of the metrics that tell good from bad. */
void add_run_table(AlignedLines& lines, const EvaluationReport& report)
{
    constexpr std::array<std::pair<const char*, const char*>, 7> kColumns{
        {{"accepted", "accepted"},
         {"wrong", "wrong"},
         {"precision", "precision"},
         {"recall", "recall"},
         {"recall, P = 1", "recall_at_full_precision_inliers"},
         {"segments", "segment_recall"},
         {"worst wrong", "worst_wrong_support"}}};
    std::ostringstream head;
    head << std::left << std::setw(kNameWidth) << "run" << std::right;
    for (const auto& [title, key] : kColumns) head << std::setw(14) << title;
    lines.headline(head.str());
    const auto runs = metrics_of_runs(report);
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
        std::ostringstream row;
        row << std::left << std::setw(kNameWidth) << i + 1 << std::right;
        for (const auto& column : kColumns)
            for (const auto& metric : runs[i])
                if (metric.key == column.second)
                    row << std::setw(14)
                        << (metric.value ? format_value(*metric.value, metric.kind) : "-");
        lines.headline(row.str());
    }
}

std::string line_of(const WrongLoop& wrong, const std::string& folder)
{
    std::ostringstream line;
    line << "frame " << to_index(wrong.verdict.frame) << " at frame "
         << to_index(wrong.verdict.candidate->frame) << ", " << wrong.verdict.inliers << " inliers"
         << (wrong.loop_query ? ", has a loop elsewhere" : ", has no loop");
    const auto picture = match_picture_of(folder, wrong.verdict);
    return line.str() + (picture.empty() ? "" : ", " + picture);
}

void add_wrong(AlignedLines& lines,
               const RunEvaluation& run,
               const std::string& number,
               std::size_t max_wrong)
{
    if (run.worst_wrong)
    {
        const auto& worst = *run.worst_wrong;
        lines.words("worst pair" + number,
                    "frame " + std::to_string(to_index(worst.frame)) + " at frame " +
                        std::to_string(to_index(worst.candidate)) + ", " +
                        std::to_string(worst.inliers) + " inliers" +
                        (worst.accepted ? ", accepted" : ", rejected"));
    }
    const auto& wrong = run.score.wrong_loops;
    for (std::size_t i = 0; i < std::min(wrong.size(), max_wrong); ++i)
        lines.words(i == 0 ? "wrong" + number : "", line_of(wrong[i], run.folder));
    if (wrong.size() > max_wrong)
        lines.words("", "and " + std::to_string(wrong.size() - max_wrong) + " more");
}
}  // namespace

std::string to_text(const EvaluationReport& report, std::size_t max_wrong)
{
    const bool several = report.runs.size() > 1;
    const auto ranges = shown(ranges_of(metrics_of_runs(report)));
    std::size_t width = 6;
    for (const auto& range : ranges) width = std::max(width, format_range(range, several).size());
    AlignedLines lines(width);
    add_origin(lines, report);
    if (several)
        lines.headline("mean [min, max] over " + std::to_string(report.runs.size()) + " runs");
    add_metrics(lines, ranges, several);
    if (several) add_run_table(lines, report);
    for (std::size_t i = 0; i < report.runs.size(); ++i)
        add_wrong(lines, report.runs[i], several ? " " + std::to_string(i + 1) : "", max_wrong);
    return lines.text();
}

}  // namespace fild
