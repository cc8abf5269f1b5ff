// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/index/place_index.h"

#include <memory>

namespace fild
{
/** Hierarchical Navigable Small World graph (Malkov and Yashunin), the graph vocabulary of FILD
 *  (IROS 2019) section III-B.2: approximate, a query costs about log(size()) descriptor
 * comparisons. The graph depends on the order of insertion and on the seed, on nothing else. */
class HnswIndex : public PlaceIndex
{
 public:
    /** Uses links_per_node, construction_width and search_width. */
    HnswIndex(const TIndexOptions& options, std::size_t dimension, std::uint64_t seed);
    ~HnswIndex() override;

    void insert(FrameId frame, const GlobalDescriptor& descriptor) override;
    std::vector<Candidate> search(const GlobalDescriptor& query, std::size_t count) const override;
    double similarity(const GlobalDescriptor& query, FrameId frame) const override;
    std::size_t size() const override;
    std::size_t descriptor_bytes() const override;

 private:
    struct Graph;  // keeps hnswlib's headers in one .cpp
    std::unique_ptr<Graph> graph_;
};

}  // namespace fild
