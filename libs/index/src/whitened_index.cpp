// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/whitened_index.h"

#include "require_dimension.h"
#include "whitening.h"

#include <utility>

namespace fild
{
WhitenedIndex::WhitenedIndex(const TIndexOptions& options, MakeIndex make_inner)
    : make_inner_(std::move(make_inner)),
      learn_at_(static_cast<std::size_t>(options.whiten_from)),
      shrinkage_(options.whitening_shrinkage),
      inner_(make_inner_())
{
}

WhitenedIndex::~WhitenedIndex() = default;

void WhitenedIndex::insert(FrameId frame, const GlobalDescriptor& descriptor)
{
    inner_->insert(frame, whitened(descriptor));
    frames_.push_back(frame);
    descriptors_.push_back(descriptor);
    if (frames_.size() == learn_at_) learn();
}

std::vector<Candidate> WhitenedIndex::search(const GlobalDescriptor& query, std::size_t count) const
{
    return inner_->search(whitened(query), count);
}

double WhitenedIndex::similarity(const GlobalDescriptor& query, FrameId frame) const
{
    return inner_->similarity(whitened(query), frame);
}

std::size_t WhitenedIndex::descriptor_bytes() const
{
    const auto own = descriptors_.empty() ? 0 : descriptors_.size() * descriptors_.front().size();
    return inner_->descriptor_bytes() + own * sizeof(float);
}

GlobalDescriptor WhitenedIndex::whitened(const GlobalDescriptor& descriptor) const
{
    if (!whitening_) return descriptor;
    require_dimension(descriptor, descriptors_.front().size());
    return whitening_->apply(descriptor);
}

void WhitenedIndex::learn()
{
    whitening_ = std::make_unique<Whitening>(descriptors_, shrinkage_);
    inner_ = make_inner_();
    for (std::size_t i = 0; i < frames_.size(); ++i)
        inner_->insert(frames_[i], whitening_->apply(descriptors_[i]));
    learn_at_ *= 2;
}

}  // namespace fild
