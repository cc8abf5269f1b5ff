// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/exact_index.h"

#include "comes_before.h"
#include "require_dimension.h"

#include <algorithm>
#include <numeric>

namespace fild
{
ExactIndex::ExactIndex(std::size_t dimension) : dimension_(dimension) {}

void ExactIndex::insert(FrameId frame, const GlobalDescriptor& descriptor)
{
    require_dimension(descriptor, dimension_);
    frames_.push_back(frame);
    descriptors_.insert(descriptors_.end(), descriptor.begin(), descriptor.end());
}

std::vector<Candidate> ExactIndex::search(const GlobalDescriptor& query, std::size_t count) const
{
    require_dimension(query, dimension_);
    std::vector<Candidate> candidates(frames_.size());
    const float* row = descriptors_.data();
    for (std::size_t i = 0; i < frames_.size(); ++i, row += dimension_)
        candidates[i] = {frames_[i], std::inner_product(query.begin(), query.end(), row, 0.0F)};
    const auto kept = static_cast<std::ptrdiff_t>(std::min(count, candidates.size()));
    std::partial_sort(
        candidates.begin(), candidates.begin() + kept, candidates.end(), comes_before);
    candidates.resize(static_cast<std::size_t>(kept));
    return candidates;
}

double ExactIndex::similarity(const GlobalDescriptor& query, FrameId frame) const
{
    require_dimension(query, dimension_);
    const auto row = std::find(frames_.rbegin(), frames_.rend(), frame);
    if (row == frames_.rend()) throw_not_in_index(frame);
    const auto i = static_cast<std::size_t>(frames_.rend() - row) - 1;
    return std::inner_product(
        query.begin(), query.end(), descriptors_.data() + i * dimension_, 0.0F);
}

}  // namespace fild
