// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/judged_frame.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** What a candidate is ranked by. */
enum class ScoreKind
{
    inliers,
    similarity
};

/** `inliers` or `similarity`. */
std::string to_word(ScoreKind kind);

/** What a run would have scored, had it accepted all candidates from a threshold up. */
struct CurvePoint
{
    double threshold = 0;
    std::size_t accepted = 0;  ///< right and wrong ones; those that are neither are left out
    std::size_t right = 0;
    double precision = 0;  ///< right / accepted
    std::optional<double> recall;  ///< right / loop queries; none: there is no loop query

    /** Harmonic mean of precision and recall; 0 when nothing is right. */
    std::optional<double> f1() const;
};

/** Precision and recall over all thresholds.
 *
 *  Each frame with a candidate (the one in frames.csv) gets the candidate's score, whether it was
 *  accepted or not; so consistency over time counts for nothing here. Threshold t accepts all
 *  frames with score >= t. Frames whose candidate is neither right nor wrong count nowhere.
 *  Every score that occurs is a threshold, once: equal scores are accepted together. */
struct PrecisionRecallCurve
{
    ScoreKind kind = ScoreKind::inliers;
    std::vector<CurvePoint> points;  ///< from the highest threshold down: recall never falls

    /** The lowest threshold at which nothing wrong is accepted, so that its recall is the recall at
     *  100 % precision. None when the best score belongs to a wrong candidate: that recall is 0. */
    std::optional<CurvePoint> at_full_precision() const;

    /** Recall there, 0 included; none without a loop query. */
    std::optional<double> recall_at_full_precision() const;

    /** The point of the greatest F1, of several the highest threshold; none without a loop query
     *  or without a point. */
    std::optional<CurvePoint> at_max_f1() const;

    /** Sum over the points of precision times the gain in recall, not interpolated. At most the
     *  last recall, as loop queries without a right candidate are never gained. */
    std::optional<double> average_precision() const;

    bool has_loop_queries = false;
};

/** The curve of a run. Cost n log n. Deterministic. */
PrecisionRecallCurve precision_recall_curve(const std::vector<JudgedFrame>& frames, ScoreKind kind);

}  // namespace fild
