// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>

namespace fild
{
/** Numbers the instants of a recording from 1: frames of several cameras that take turns are one
 *  instant, and a new one begins with the first camera that comes again. With a single camera each
 *  frame is an instant. Not thread-safe: one caller at a time. */
class InstantCounter
{
 public:
    /** \param camera  of the next frame. \return the frame's instant. */
    std::size_t add(const std::string& camera)
    {
        if (!cameras_.insert(camera).second) cameras_ = {camera};
        if (cameras_.size() == 1) ++instant_;
        return instant_;
    }

 private:
    std::size_t instant_ = 0;
    std::set<std::string> cameras_;  ///< with a frame in this instant
};

}  // namespace fild
