// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"
#include "fild/index/index_options.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fild
{
/** Finds the frames whose global descriptors are most similar to a query's; grows frame by frame.
 *  Not thread-safe: one caller at a time. */
class PlaceIndex
{
 public:
    PlaceIndex() = default;
    PlaceIndex(const PlaceIndex&) = delete;
    PlaceIndex& operator=(const PlaceIndex&) = delete;
    virtual ~PlaceIndex() = default;

    /** \throw std::invalid_argument when the descriptor is not of the index's dimension. */
    virtual void insert(FrameId frame, const GlobalDescriptor& descriptor) = 0;

    /** At most `count` frames, most similar first, equals by frame; fewer when fewer are in.
     *  Deterministic. \throw std::invalid_argument as insert(). */
    virtual std::vector<Candidate> search(const GlobalDescriptor& query,
                                          std::size_t count) const = 0;

    /** How similar a frame of the index is to the query: what search() would say of it.
     *  \throw std::invalid_argument as insert(), or when the frame is not in the index. */
    virtual double similarity(const GlobalDescriptor& query, FrameId frame) const = 0;

    virtual std::size_t size() const = 0;

    /** Memory of descriptors, bytes. */
    virtual std::size_t descriptor_bytes() const = 0;
};

/** The index that options.backend names, empty, for descriptors of `dimension` numbers. The seed
 *  drives the random layers of the HNSW graph. */
std::unique_ptr<PlaceIndex> make_place_index(const TIndexOptions& options,
                                             std::size_t dimension,
                                             std::uint64_t seed);

}  // namespace fild
