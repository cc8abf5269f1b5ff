// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/frame_reader.h"
#include "run_steps.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace fild
{
/** A step that wants images of single frames. */
struct ImageConsumer
{
    RunStep step;
    std::set<FrameId> wanted{};
    std::function<void(const Frame&)> take;
};

/** Reads the rawlog of a run once more, for all steps that want something of single frames. Refers
 *  to its steps. Not thread-safe: one caller at a time. */
class SecondPass
{
 public:
    SecondPass(std::string rawlog, TInputOptions input, RunSteps& steps);

    /** Before the first frame is read. What the consumer throws ends its own part only. */
    void add(ImageConsumer consumer);

    /** What the camera saw at a frame; consumers take the frames up to it.
     *  \param frame  later than those before.
     *  \throw Interrupted, std::runtime_error as FrameReader. */
    std::vector<std::shared_ptr<mrpt::obs::CObservation>> observations_at(FrameId frame);

    /** Reads on until the consumers have what they want, or the user interrupts.
     *  \throw std::runtime_error as FrameReader. */
    void finish();

 private:
    bool move_to_next();
    FrameId last_wanted() const;
    void serve();

    std::string rawlog_;
    TInputOptions input_;
    RunSteps& steps_;
    std::vector<ImageConsumer> consumers_;
    std::unique_ptr<FrameReader> frames_;  ///< none: nothing is read yet
};

}  // namespace fild
