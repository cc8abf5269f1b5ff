// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
class CSensoryFrame;
}  // namespace mrpt::obs

namespace fild
{
/** Writes observations to a gzipped rawlog that appears under its name only when it is whole (see
 *  WholeFile). Not thread-safe: one caller at a time. */
class RawlogWriter
{
 public:
    /** \throw std::runtime_error with path and reason when the file cannot be created. */
    explicit RawlogWriter(const std::string& path);
    RawlogWriter(const RawlogWriter&) = delete;
    RawlogWriter& operator=(const RawlogWriter&) = delete;
    ~RawlogWriter();

    /** Appends one observation; images as they are, never recompressed as JPEG unless the process
     *  asked MRPT for that. \throw std::runtime_error when the disk is full. */
    void write(const mrpt::obs::CObservation& observation);

    /** Appends one step of a rawlog of actions and sensory frames: what moved the robot, and what
     *  it saw then. A rawlog is made of such steps or of observations, not of both. Throws as the
     *  other write(). */
    void write(const mrpt::obs::CActionCollection& actions,
               const mrpt::obs::CSensoryFrame& observations);

    /** Closes the file and gives it its name; to be called once, nothing may be written after.
     *  \throw std::runtime_error when the disk is full. */
    void commit();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
