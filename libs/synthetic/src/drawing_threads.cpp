// SPDX-License-Identifier: BSD-3-Clause
#include "drawing_threads.h"

#include <utility>

namespace fild
{
/** Waits for the helper's next frame. */
DrawnFrame DrawingThreads::Helper::take()
{
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return finished || error; });
    if (!finished) std::rethrow_exception(error);
    auto frame = std::move(*finished);
    finished.reset();
    changed.notify_all();
    return frame;
}

/** Called by the helper; waits until the frame before was taken. False when it is to stop. */
bool DrawingThreads::Helper::hand_over(DrawnFrame frame)
{
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return !finished || stopped; });
    if (stopped) return false;
    finished = std::move(frame);
    changed.notify_all();
    return true;
}

void DrawingThreads::Helper::stop()
{
    {
        const std::lock_guard lock(mutex);
        stopped = true;
        changed.notify_all();
    }
    if (thread.joinable()) thread.join();
}

DrawingThreads::DrawingThreads(std::size_t frames,
                               const DrawView& own,
                               const DrawingHelpers& helpers,
                               DrawFrame draw_frame)
    : own_(own), draw_frame_(std::move(draw_frame))
{
    for (std::size_t i = 0; i < helpers.count; ++i) helpers_.push_back(std::make_unique<Helper>());
    const auto work = [this, frames, make = helpers.make](Helper& helper, std::size_t first)
    {
        try
        {
            const auto draw = make();
            for (auto i = first; i < frames; i += helpers_.size() + 1)
                if (!helper.hand_over(draw_frame_(i, draw))) return;
        }
        catch (...)  // handed to who takes the frame
        {
            const std::lock_guard lock(helper.mutex);
            helper.error = std::current_exception();
            helper.changed.notify_all();
        }
    };
    try
    {
        for (std::size_t i = 0; i < helpers_.size(); ++i)
            helpers_[i]->thread = std::thread(work, std::ref(*helpers_[i]), i + 1);
    }
    catch (...)  // no more threads to be had
    {
        stop();
        throw;
    }
}

DrawingThreads::~DrawingThreads()
{
    stop();
}

void DrawingThreads::stop()
{
    for (const auto& helper : helpers_) helper->stop();
}

DrawnFrame DrawingThreads::frame(std::size_t frame)
{
    const auto turn = frame % (helpers_.size() + 1);
    return turn == 0 ? draw_frame_(frame, own_) : helpers_[turn - 1]->take();
}

}  // namespace fild
