// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/loop_truth.h"
#include "fild/evaluation/measured_path.h"
#include "fild/evaluation/protocol.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Where the frames of a run truly were. */
struct TruePoses
{
    std::string content;  ///< "KITTI poses of 500 frames"
    std::vector<std::string> remarks;
    std::vector<PosedFrame> frames;  ///< of the run, all of them
    bool oriented = true;  ///< false: orientations are headings out of the motion
};

/** Ground truth, ready to be asked. */
struct GroundTruth
{
    std::string content;  ///< "loop matrix of 3474 frames, 10811 pairs"
    std::vector<std::string> remarks;  ///< what was found odd and how it was taken; mostly none
    std::unique_ptr<LoopTruth> truth;
    std::optional<TruePoses> poses;  ///< none: made of labels
};

/** Loads a ground-truth file of a run. What it is shows in its content: a MATLAB file is a loop
 *  matrix; of text, the first line that is neither blank nor a comment has 2 or 3 numbers
 *  (list of loops), 8 (TUM poses) or 12 (KITTI poses).
 *  \throw std::invalid_argument when the protocol does not go with the file: poses need `radius:R`,
 *         labels `exact` or `window:N`.
 *  \throw std::runtime_error naming the file: unreadable or of unknown format, of another length
 *         than the run, naming frames that the run does not have, or without any loop. Poses
 *         without a return are no error: a run has nothing to find there. */
GroundTruth load_ground_truth(const std::string& path,
                              const std::vector<FrameVerdict>& frames,
                              const Protocol& protocol);

/** True for a file of poses, false for one of labels; only its first lines are read.
 *  \throw std::runtime_error naming the file: missing, unreadable or of unknown format. */
bool holds_poses(const std::string& path);

/** Reads a file of TUM or KITTI poses, which of them shows in its content.
 *  \throw std::runtime_error naming the file: as above, or when it holds labels. */
TruePoses load_true_poses(const std::string& path, const std::vector<FrameVerdict>& frames);

/** The poses of the frames along a measured path, see poses_along().
 *  \param content  what the path is, "GPS 'GPS1'".
 *  \throw std::runtime_error when no frame has a pose. */
TruePoses true_poses_along(const MeasuredPath& path,
                           const std::string& content,
                           const std::vector<FrameVerdict>& frames);

/** Poses as ground truth of loops.
 *  \throw std::invalid_argument when the protocol is not `radius:R`. */
GroundTruth ground_truth_of(TruePoses poses, const Protocol& protocol);

}  // namespace fild
