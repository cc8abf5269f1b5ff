// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/synthetic_recording.h"

#include <opencv2/core/mat.hpp>

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace fild
{
/** What the cameras see at one frame. Value type. */
struct DrawnFrame
{
    std::vector<cv::Mat> images;
    cv::Mat depth;  ///< of the first
};

/** Draws one frame by the means given. Called from several threads at once. */
using DrawFrame = std::function<DrawnFrame(std::size_t frame, const DrawView& draw)>;

/** Draws the frames of a recording by the calling thread and its helpers in turn; each helper is at
 *  most two frames ahead. Not thread-safe: one caller at a time. */
class DrawingThreads
{
 public:
    /** \param own  draws the calling thread's frames; it is not copied. */
    DrawingThreads(std::size_t frames,
                   const DrawView& own,
                   const DrawingHelpers& helpers,
                   DrawFrame draw_frame);
    DrawingThreads(const DrawingThreads&) = delete;
    DrawingThreads& operator=(const DrawingThreads&) = delete;
    ~DrawingThreads();

    /** Frames are asked for in order, from 0. Throws what drawing the frame threw. */
    DrawnFrame frame(std::size_t frame);

 private:
    /** A helper, and the frame that it has finished. */
    struct Helper
    {
        std::mutex mutex;  ///< guards what follows, but for the thread
        std::condition_variable changed;
        std::optional<DrawnFrame> finished;
        std::exception_ptr error;
        bool stopped = false;
        std::thread thread;

        DrawnFrame take();
        bool hand_over(DrawnFrame frame);
        void stop();
    };

    void stop();

    const DrawView& own_;
    DrawFrame draw_frame_;
    std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace fild
