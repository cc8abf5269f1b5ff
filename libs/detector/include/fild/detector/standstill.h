// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"

#include <map>
#include <optional>
#include <string>

namespace fild
{
/** Recognises from its keypoints alone that a camera stands still, and how long the recording has
 *  been on the move.
 *
 *  A frame shows what a frame before it showed when at least 30 % of that frame's keypoints are
 *  again within 1.5 pixels, with codes that differ in at most a fifth of the bits. A camera that
 *  moves on leaves these positions soon, people who walk past hide only some of them. When all
 *  frames of some time show what the first of them showed, the camera stands still from the end of
 *  that time on. Deterministic. Not thread-safe: one caller at a time. */
class Standstill
{
 public:
    /** \param least_seconds  that a camera stands still for until it counts; 0: it never does. */
    explicit Standstill(double least_seconds) : least_seconds_(least_seconds) {}

    /** Takes the next frame.
     *  \param camera  its label. \param now  seconds, never less than for the frame before.
     *  \return since which frame its camera stands still; nothing when it does not. */
    std::optional<FrameId> add(FrameId frame,
                               const std::string& camera,
                               const HashedFeatures& features,
                               double now);

    /** Seconds up to the last frame, without the steps to frames whose camera stood still. */
    double moving_seconds() const { return moving_seconds_; }

 private:
    /** The frame that those after it are compared with. */
    struct Anchor
    {
        FrameId frame{};
        double now = 0;
        HashedFeatures features;
    };

    double least_seconds_;
    std::map<std::string, Anchor> anchors_;  ///< by camera
    double now_ = 0;
    double moving_seconds_ = 0;
};

/** Share of the keypoints of `before` that are again in `after`, as Standstill says; 0 where there
 *  are fewer than 20. Costs time in proportion to their number. */
double repeated_share(const HashedFeatures& before, const HashedFeatures& after);

}  // namespace fild
