// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/paired_rawlog.h"

#include <memory>
#include <string>

namespace fild
{
/** Walks over the camera frames of a rawlog: the same frames, with the same ids, as those of a
 *  LoopClosureStream that is given all of the rawlog.
 *  \code
 *  while (frames.next())
 *      if (wanted.count(frames.id())) draw(frames.build());
 *  \endcode
 *  Deterministic. Not thread-safe: one caller at a time. */
class FrameReader
{
 public:
    /** \throw std::runtime_error as RawlogReader, std::invalid_argument on bad options. */
    FrameReader(const std::string& rawlog, const TInputOptions& options);

    /** Moves to the next frame. Its image is not read, but for the first of each camera.
     *  \return false at the end. \throw std::runtime_error as PairedRawlog and FrameBuilder. */
    bool next();

    /** Of the frame that next() moved to. */
    FrameId id() const { return id_; }
    const std::shared_ptr<mrpt::obs::CObservation>& observation() const { return observation_; }

    /** The frame that next() moved to. At most one of these two, once.
     *  \throw std::runtime_error, std::invalid_argument as FrameBuilder. */
    Frame build();
    Frame skip();

    /** As RawlogReader. */
    double fraction_read() const { return rawlog_.fraction_read(); }

    /** What it knows of all frames so far. */
    const FrameBuilder& builder() const { return builder_; }

 private:
    PairedRawlog rawlog_;
    FrameBuilder builder_;
    std::shared_ptr<mrpt::obs::CObservation> observation_;
    FrameId id_{};
};

}  // namespace fild
