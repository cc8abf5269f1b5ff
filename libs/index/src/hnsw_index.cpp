// SPDX-License-Identifier: BSD-3-Clause
// The graph vocabulary of FILD (An et al., IROS 2019), section III-B.2 and III-B.3.
#include "fild/index/hnsw_index.h"

#include "comes_before.h"
#include "require_dimension.h"

#ifdef __SANITIZE_ADDRESS__
// hnswlib 0.6.2 prefetches through the link after the last one of a full list: four bytes past the
// end of a heap block, which are read and not used. The address sanitizer would stop there.
#define NO_MANUAL_VECTORIZATION
#endif
#include <hnswlib/hnswlib.h>

#include <algorithm>

namespace fild
{
namespace
{
constexpr std::size_t kFirstCapacity = 1024;
}

struct HnswIndex::Graph
{
    Graph(const TIndexOptions& options, std::size_t dimension_in, std::uint64_t seed)
        : dimension(dimension_in),
          space(dimension_in),
          hnsw(&space,
               kFirstCapacity,
               static_cast<std::size_t>(options.links_per_node),
               static_cast<std::size_t>(options.construction_width),
               seed)
    {
        hnsw.setEf(static_cast<std::size_t>(options.search_width));
    }

    std::size_t dimension;
    hnswlib::InnerProductSpace space;
    hnswlib::HierarchicalNSW<float> hnsw;
};

HnswIndex::HnswIndex(const TIndexOptions& options, std::size_t dimension, std::uint64_t seed)
    : graph_(std::make_unique<Graph>(options, dimension, seed))
{
}

HnswIndex::~HnswIndex() = default;

void HnswIndex::insert(FrameId frame, const GlobalDescriptor& descriptor)
{
    require_dimension(descriptor, graph_->dimension);
    auto& hnsw = graph_->hnsw;
    if (hnsw.cur_element_count >= hnsw.max_elements_) hnsw.resizeIndex(2 * hnsw.max_elements_);
    hnsw.addPoint(descriptor.data(), to_index(frame));
}

std::vector<Candidate> HnswIndex::search(const GlobalDescriptor& query, std::size_t count) const
{
    require_dimension(query, graph_->dimension);
    if (size() == 0) return {};
    auto farthest_first = graph_->hnsw.searchKnn(query.data(), count);
    std::vector<Candidate> candidates;
    for (; !farthest_first.empty(); farthest_first.pop())
    {
        const auto [distance, label] = farthest_first.top();  // distance is 1 - scalar product
        candidates.push_back({FrameId{label}, 1.0 - static_cast<double>(distance)});
    }
    std::sort(candidates.begin(), candidates.end(), comes_before);
    return candidates;
}

double HnswIndex::similarity(const GlobalDescriptor& query, FrameId frame) const
{
    require_dimension(query, graph_->dimension);
    auto& hnsw = graph_->hnsw;
    const auto found = hnsw.label_lookup_.find(to_index(frame));
    if (found == hnsw.label_lookup_.end()) throw_not_in_index(frame);
    const auto* descriptor = hnsw.getDataByInternalId(found->second);
    return 1.0 -
           static_cast<double>(hnsw.fstdistfunc_(query.data(), descriptor, hnsw.dist_func_param_));
}

std::size_t HnswIndex::size() const
{
    return graph_->hnsw.cur_element_count;
}

std::size_t HnswIndex::descriptor_bytes() const
{
    return size() * graph_->dimension * sizeof(float);
}

}  // namespace fild
