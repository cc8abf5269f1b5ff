// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/precision_recall_curve.h"

#include "share.h"

#include <algorithm>
#include <functional>
#include <map>

namespace fild
{
namespace
{
struct Counts
{
    std::size_t right = 0;
    std::size_t wrong = 0;
};

double score_of(const FrameVerdict& verdict, ScoreKind kind)
{
    return kind == ScoreKind::inliers ? static_cast<double>(verdict.inliers)
                                      : verdict.candidate->similarity;
}

/** Right and wrong candidates by score, the highest first. */
std::map<double, Counts, std::greater<>> count_by_score(const std::vector<JudgedFrame>& frames,
                                                        ScoreKind kind)
{
    std::map<double, Counts, std::greater<>> counts;
    for (const auto& frame : frames)
    {
        if (!frame.judgement || frame.judgement == Judgement::neither) continue;
        auto& at_score = counts[score_of(frame.verdict, kind)];
        ++(frame.judgement == Judgement::right ? at_score.right : at_score.wrong);
    }
    return counts;
}
}  // namespace

std::string to_word(ScoreKind kind)
{
    return kind == ScoreKind::inliers ? "inliers" : "similarity";
}

std::optional<double> CurvePoint::f1() const
{
    if (!recall) return std::nullopt;
    return right == 0 ? 0 : 2 * precision * *recall / (precision + *recall);
}

std::optional<CurvePoint> PrecisionRecallCurve::at_full_precision() const
{
    std::optional<CurvePoint> last;
    for (const auto& point : points)
        if (point.right == point.accepted) last = point;
    return last;
}

std::optional<double> PrecisionRecallCurve::recall_at_full_precision() const
{
    if (!has_loop_queries) return std::nullopt;
    const auto point = at_full_precision();
    return point ? point->recall : 0;
}

std::optional<CurvePoint> PrecisionRecallCurve::at_max_f1() const
{
    const auto best =
        std::max_element(points.begin(),
                         points.end(),
                         [](const CurvePoint& a, const CurvePoint& b) { return a.f1() < b.f1(); });
    if (!has_loop_queries || best == points.end()) return std::nullopt;
    return *best;
}

std::optional<double> PrecisionRecallCurve::average_precision() const
{
    if (!has_loop_queries) return std::nullopt;
    double sum = 0;
    double recall_before = 0;
    for (const auto& point : points)
    {
        sum += point.precision * (*point.recall - recall_before);
        recall_before = *point.recall;
    }
    return sum;
}

PrecisionRecallCurve precision_recall_curve(const std::vector<JudgedFrame>& frames, ScoreKind kind)
{
    const auto loop_queries = static_cast<std::size_t>(std::count_if(
        frames.begin(), frames.end(), [](const JudgedFrame& frame) { return frame.loop_query; }));
    PrecisionRecallCurve curve;
    curve.kind = kind;
    curve.has_loop_queries = loop_queries > 0;
    CurvePoint point;
    for (const auto& [score, counts] : count_by_score(frames, kind))
    {
        point.threshold = score;
        point.right += counts.right;
        point.accepted += counts.right + counts.wrong;
        point.precision = share(point.right, point.accepted).value();
        point.recall = share(point.right, loop_queries);
        curve.points.push_back(point);
    }
    return curve;
}

}  // namespace fild
