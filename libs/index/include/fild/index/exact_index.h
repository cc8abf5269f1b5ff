// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/index/place_index.h"

namespace fild
{
/** Linear scan: always right; a query costs size() x dimension multiplications. */
class ExactIndex : public PlaceIndex
{
 public:
    explicit ExactIndex(std::size_t dimension);

    void insert(FrameId frame, const GlobalDescriptor& descriptor) override;
    std::vector<Candidate> search(const GlobalDescriptor& query, std::size_t count) const override;
    double similarity(const GlobalDescriptor& query, FrameId frame) const override;
    std::size_t size() const override { return frames_.size(); }
    std::size_t descriptor_bytes() const override { return descriptors_.size() * sizeof(float); }

 private:
    std::size_t dimension_;
    std::vector<FrameId> frames_;
    std::vector<float> descriptors_;  ///< size() x dimension, row-major
};

}  // namespace fild
