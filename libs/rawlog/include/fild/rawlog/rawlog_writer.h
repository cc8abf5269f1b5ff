// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

namespace mrpt::obs
{
class CObservation;
}

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

    /** Closes the file and gives it its name; to be called once, nothing may be written after.
     *  \throw std::runtime_error when the disk is full. */
    void commit();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
