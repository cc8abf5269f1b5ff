// SPDX-License-Identifier: BSD-3-Clause
#include "second_pass.h"

#include "fild/job/interruption.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fild
{
SecondPass::SecondPass(std::string rawlog, TInputOptions input, RunSteps& steps)
    : rawlog_(std::move(rawlog)), input_(std::move(input)), steps_(steps)
{
}

void SecondPass::add(ImageConsumer consumer)
{
    if (!consumer.wanted.empty()) consumers_.push_back(std::move(consumer));
}

std::vector<std::shared_ptr<mrpt::obs::CObservation>> SecondPass::observations_at(FrameId frame)
{
    while (move_to_next())
    {
        throw_if_interrupted();
        const auto id = frames_->id();
        const auto observation = frames_->observation();
        serve();
        if (id == frame) return {observation};
    }
    return {};
}

void SecondPass::finish()
{
    while (!consumers_.empty() && !interrupted())
    {
        if (frames_ && frames_->id() >= last_wanted()) return;
        if (!move_to_next()) return;
        serve();
    }
}

bool SecondPass::move_to_next()
{
    if (!frames_) frames_ = std::make_unique<FrameReader>(rawlog_, input_);
    return frames_->next();
}

FrameId SecondPass::last_wanted() const
{
    FrameId last{};
    for (const auto& consumer : consumers_) last = std::max(last, *consumer.wanted.rbegin());
    return last;
}

/** Gives the frame to those who want it; who fails gets no more. */
void SecondPass::serve()
{
    const auto id = frames_->id();
    const auto wants = [&](const ImageConsumer& consumer)
    { return consumer.wanted.count(id) != 0; };
    if (std::none_of(consumers_.begin(), consumers_.end(), wants)) return;
    const auto frame = frames_->build();
    const auto fails = [&](const ImageConsumer& consumer)
    {
        return wants(consumer) &&
               !steps_.attempt(consumer.step,
                               [&]
                               {
                                   if (frame.defect != Rejection::none)
                                       throw std::runtime_error("the image of frame " +
                                                                std::to_string(to_index(id)) +
                                                                " is gone since the run began");
                                   consumer.take(frame);
                               });
    };
    consumers_.erase(std::remove_if(consumers_.begin(), consumers_.end(), fails), consumers_.end());
}

}  // namespace fild
