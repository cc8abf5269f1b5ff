// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/keypoint_depths.h"
#include "fild/core/stage_times.h"
#include "fild/detector/pair_verifier.h"
#include "fild/graph/trajectory.h"
#include "fild/places/place_map.h"

#include <cstddef>
#include <optional>

namespace fild
{
/** Depths of a single camera's keypoints: frames are triangulated against others of the same camera
 *  (depths_from_motion()), with the distance between them from the robot's trajectory.
 *
 *  The others are tried by distance, each half as far again as the one before, until the images
 *  have less and less in common; that counts which gives the most depths. Earlier frames first; at
 *  the beginning of a drive, where these give too few, later ones too. Deterministic. Const members
 *  may run concurrently, each with its own StageTimes. */
class MotionScale
{
 public:
    /** So many frames are looked at in either direction: a robot may have stood still. */
    static constexpr std::size_t kMaxFrames = 300;

    /** \param detector,trajectory  outlive this. \throw std::invalid_argument on bad options. */
    MotionScale(const PlaceMap& places,
                const Trajectory& trajectory,
                const TDetectorOptions& options);

    /** \param times receives "motion_depth", "matching" and "verification".
     *  \return source none when no other frame serves. */
    KeypointDepths depths_of(FrameId frame, StageTimes& times) const;

 private:
    enum class Direction
    {
        earlier,
        later
    };

    KeypointDepths best_of(FrameId frame, Direction direction, StageTimes& times) const;
    std::optional<FrameId> next(FrameId frame, Direction direction) const;
    KeypointDepths against(FrameId frame,
                           FrameId other,
                           const RelativeMotion& other_from_frame,
                           StageTimes& times) const;

    const PlaceMap& places_;
    const Trajectory& trajectory_;
    PairVerifier pairs_;
    TDepthOptions options_;
    std::size_t enough_;  ///< depths
    std::uint64_t seed_;
};

}  // namespace fild
