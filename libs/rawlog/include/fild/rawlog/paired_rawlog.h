// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/paired_observations.h"
#include "fild/rawlog/rawlog_reader.h"

#include <exception>
#include <memory>
#include <string>

namespace fild
{
/** Reads a rawlog as RawlogReader does, two cameras that are a stereo pair as one: for a second
 *  pass over what was given to a LoopClosureStream, with the same frames.
 *  Not thread-safe: one caller at a time. */
class PairedRawlog
{
 public:
    /** \throw std::runtime_error as RawlogReader, std::invalid_argument on bad options. */
    PairedRawlog(const std::string& path, const TInputOptions& options);

    /** The next observation, or null at the end. Throws as StereoPairing, and as RawlogReader after
     *  all that can be read. */
    std::shared_ptr<mrpt::obs::CObservation> next();

    /** As RawlogReader. */
    double fraction_read() const { return reader_.fraction_read(); }

 private:
    void read_on();

    RawlogReader reader_;
    PairedObservations observations_;
    bool has_ended_ = false;
    std::exception_ptr damage_;
};

}  // namespace fild
