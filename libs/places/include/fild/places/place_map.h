// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/places/place.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

namespace fild
{
/** All places of a recording, in the order of their frames. A place stays where it is in memory.
 *  Const members may run concurrently, but not beside append(). */
class PlaceMap
{
 public:
    /** \throw std::invalid_argument when the frame does not come after those that are in the map.
     *  */
    void append(FrameId frame, Place place);

    /** Null for a frame that could not be used, or is not there yet. */
    const Place* find(FrameId frame) const;

    /** \throw std::out_of_range where find() is null. */
    const Place& at(FrameId frame) const;

    /** The next frame of the same camera at which that camera did not stand still; none at the
     *  ends.
     *  \throw std::out_of_range as at(). */
    std::optional<FrameId> after(FrameId frame) const;
    /** As after(), backwards. */
    std::optional<FrameId> before(FrameId frame) const;

    /** The frame of a camera at the same instant; the frame itself where that camera has none, or
     *  stands still.
     *  \throw std::out_of_range as at(). */
    FrameId seen_by(const std::string& camera, FrameId frame) const;

    std::size_t size() const { return entries_.size(); }

    /** Memory of codes, positions, cells and depths. */
    std::size_t bytes() const { return bytes_; }

 private:
    struct Entry
    {
        FrameId frame{};
        Place place;
    };
    using Position = std::deque<Entry>::const_iterator;

    Position position_of(FrameId frame) const;

    std::deque<Entry> entries_;
    std::size_t bytes_ = 0;
};

}  // namespace fild
