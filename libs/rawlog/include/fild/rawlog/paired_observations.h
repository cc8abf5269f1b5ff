// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/stereo_pairing.h"

#include <deque>
#include <memory>

namespace fild
{
/** Observations in the order in which they can be looked at: two cameras that are a stereo pair as
 *  one, as soon as both images are there. Not thread-safe: one caller at a time. */
class PairedObservations
{
 public:
    using Observation = std::shared_ptr<mrpt::obs::CObservation>;

    /** \throw std::invalid_argument as StereoPairing. */
    explicit PairedObservations(const TInputOptions& options) : pairing_(options) {}

    /** \return true when the pairing keeps the observation; else it is to be looked at after those
     *  that are ready. \throw std::runtime_error as StereoPairing. */
    bool feed(const mrpt::obs::CObservation& observation);

    /** Puts an observation behind those that are ready. */
    void append(Observation observation) { ready_.push_back(std::move(observation)); }

    /** No observation follows: images without partners are ready. */
    void finish();

    bool empty() const { return ready_.empty(); }

    /** The first one that is ready; null when there is none. */
    Observation take();

    const StereoPairing& pairing() const { return pairing_; }

 private:
    StereoPairing pairing_;
    std::deque<Observation> ready_;
};

}  // namespace fild
