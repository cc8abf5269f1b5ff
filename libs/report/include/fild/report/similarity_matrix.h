// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** How alike the frames of a run are, by their global descriptors: a picture of at most so many
 *  rows. It keeps every frame until there are too many, then every second one, every fourth...
 *  Memory and the picture are so bounded for a run of any length. Not thread-safe: one caller at a
 *  time. */
class SimilarityMatrix
{
 public:
    /** \param max_frames  at least 1. \throw std::invalid_argument */
    explicit SimilarityMatrix(std::size_t max_frames);

    /** Frames come in increasing id, without gaps. \param descriptor  empty: the frame could not be
     *  used. */
    void add(FrameId frame, const GlobalDescriptor& descriptor);

    /** From one row, or column, to the next. */
    std::size_t frames_per_row() const { return frames_per_row_; }

    /** Writes an 8 bit grey PNG: row r, column c < r is 255 x cosine, 0 for a negative one, of the
     *  descriptors of frames r and c x frames_per_row(), without the mean that all of them share;
     *  the rest is 0. Costs frames^2 / 2 scalar products.
     *  \throw std::runtime_error as WholeFile. */
    void write_png(const std::string& path) const;

 private:
    void thin_out();
    std::vector<GlobalDescriptor> centred() const;

    std::size_t max_frames_;
    std::size_t frames_per_row_ = 1;
    std::vector<GlobalDescriptor> descriptors_;  ///< of frames 0, frames_per_row_, ...
};

}  // namespace fild
