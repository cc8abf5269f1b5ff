// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/loop_labels.h"
#include "fild/evaluation/protocol.h"

#include <vector>

namespace fild
{
/** What the truth says of a loop closure. */
enum class Judgement
{
    right,
    wrong,
    neither  ///< the truth cannot tell, or it is no return: counts for nothing
};

/** Ground truth under one protocol. Const members may run concurrently. */
class LoopTruth
{
 public:
    LoopTruth() = default;
    LoopTruth(const LoopTruth&) = delete;
    LoopTruth& operator=(const LoopTruth&) = delete;
    virtual ~LoopTruth() = default;

    /** Does the frame come back to an earlier place? Recall is the share of these that are answered
     *  rightly. */
    virtual bool is_loop_query(FrameId query) const = 0;

    /** \param candidate  earlier than `query`. */
    virtual Judgement judge(FrameId query, FrameId candidate) const = 0;
};

/** Labels under `exact` or `window:N`. A loop query is a frame with a label. A loop closure is
 * right when its candidate is at most N columns (exact: 0) from a labelled one of the same query;
 *  neither when the pair is labelled as doubtful; all others are wrong. */
class LabelTruth : public LoopTruth
{
 public:
    LabelTruth(LoopLabels labels, std::size_t window);

    bool is_loop_query(FrameId query) const override;
    Judgement judge(FrameId query, FrameId candidate) const override;

 private:
    LoopLabels labels_;
    std::size_t window_;
};

/** Poses under `radius:R`. The candidate shows the place of the query when the positions are at
 * most `radius` apart and the rotation between the poses is at most `max_angle_deg`. If it is at
 * least `min_age_seconds` older it is right, and a frame that has such a candidate is a loop query;
 * if it is younger, the camera had not left the place: neither right nor wrong. So is a loop
 * closure of frames without a pose. All others are wrong, the same place seen in another direction
 * included. */
class PoseTruth : public LoopTruth
{
 public:
    PoseTruth(std::vector<PosedFrame> frames, const Protocol& protocol);

    /** Cost linear in the number of frames. */
    bool is_loop_query(FrameId query) const override;
    Judgement judge(FrameId query, FrameId candidate) const override;

 private:
    std::vector<PosedFrame> frames_;
    Protocol protocol_;
};

}  // namespace fild
