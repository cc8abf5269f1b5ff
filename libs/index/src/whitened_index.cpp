// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/whitened_index.h"

#include "fild/core/spread.h"
#include "require_dimension.h"
#include "whitening.h"

#include <utility>

namespace fild
{
namespace
{
constexpr std::size_t kAtOnce = 4096;  // frames
constexpr std::size_t kSlice = 5;  // insertions
constexpr std::size_t kMostLearntFrom = 16384;

std::vector<GlobalDescriptor> sample_of(const std::vector<GlobalDescriptor>& descriptors)
{
    std::vector<GlobalDescriptor> sample;
    for (const auto i : spread_indices(kMostLearntFrom, descriptors.size()))
        sample.push_back(descriptors[i]);
    return sample;
}
}  // namespace

WhitenedIndex::WhitenedIndex(const TIndexOptions& options, MakeIndex make_inner)
    : make_inner_(std::move(make_inner)),
      learn_at_(static_cast<std::size_t>(options.whiten_from)),
      shrinkage_(options.whitening_shrinkage),
      current_{nullptr, make_inner_()}
{
}

WhitenedIndex::~WhitenedIndex() = default;

void WhitenedIndex::insert(FrameId frame, const GlobalDescriptor& descriptor)
{
    current_.inner->insert(frame, whitened(descriptor));
    frames_.push_back(frame);
    descriptors_.push_back(descriptor);
    if (next_)
        fill_next(kSlice);
    else if (frames_.size() == learn_at_)
        learn();
}

std::vector<Candidate> WhitenedIndex::search(const GlobalDescriptor& query, std::size_t count) const
{
    return current_.inner->search(whitened(query), count);
}

double WhitenedIndex::similarity(const GlobalDescriptor& query, FrameId frame) const
{
    return current_.inner->similarity(whitened(query), frame);
}

std::size_t WhitenedIndex::descriptor_bytes() const
{
    const auto own = descriptors_.empty() ? 0 : descriptors_.size() * descriptors_.front().size();
    return current_.inner->descriptor_bytes() + (next_ ? next_->inner->descriptor_bytes() : 0) +
           own * sizeof(float);
}

GlobalDescriptor WhitenedIndex::whitened(const GlobalDescriptor& descriptor) const
{
    if (!current_.whitening) return descriptor;
    require_dimension(descriptor, descriptors_.front().size());
    return current_.whitening->apply(descriptor);
}

void WhitenedIndex::learn()
{
    next_ = Learnt{std::make_unique<Whitening>(sample_of(descriptors_), shrinkage_), make_inner_()};
    learn_at_ *= 2;
    if (frames_.size() <= kAtOnce) fill_next(frames_.size());
}

/** Inserts what the next index lacks; when it has all, it takes over. */
void WhitenedIndex::fill_next(std::size_t insertions)
{
    auto& [whitening, inner] = *next_;
    for (; insertions > 0 && inner->size() < frames_.size(); --insertions)
    {
        const auto i = inner->size();
        inner->insert(frames_[i], whitening->apply(descriptors_[i]));
    }
    if (inner->size() < frames_.size()) return;
    current_ = std::move(*next_);
    next_.reset();
}

}  // namespace fild
