// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/index/place_index.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace fild
{
class Whitening;

/** An index that learns from its own descriptors what they have in common, and searches by what is
 *  left: along one street, or in one building, all images look alike, and their mean and their main
 *  directions of variation say nothing about the place (after Jegou and Chum, ECCV 2012). Not in
 *  the paper.
 *
 *  Similarity is the cosine of the whitened descriptors, about 0 for unrelated places. It is learnt
 *  anew, and the inner index filled again, when the map has whiten_from frames and each time it has
 *  doubled since: on the whole twice the insertions, and once a doubling dimension^3 / 3
 *  multiplications. Before that it is the inner index as it is. Deterministic.
 *
 *  A map of more than 4096 frames is not filled again at once: each insertion then does five more,
 *  and what was learnt counts when the map has a quarter more frames. It is learnt from at most
 *  16384 frames, evenly over the map. */
class WhitenedIndex : public PlaceIndex
{
 public:
    using MakeIndex = std::function<std::unique_ptr<PlaceIndex>()>;

    /** \param make_inner  makes an empty index for descriptors of the same dimension.
     *  Uses whiten_from (at least 1) and whitening_shrinkage. */
    WhitenedIndex(const TIndexOptions& options, MakeIndex make_inner);
    ~WhitenedIndex() override;

    void insert(FrameId frame, const GlobalDescriptor& descriptor) override;
    std::vector<Candidate> search(const GlobalDescriptor& query, std::size_t count) const override;
    double similarity(const GlobalDescriptor& query, FrameId frame) const override;
    std::size_t size() const override { return frames_.size(); }
    std::size_t descriptor_bytes() const override;

 private:
    /** An inner index and what its descriptors are whitened with. */
    struct Learnt
    {
        std::unique_ptr<Whitening> whitening;
        std::unique_ptr<PlaceIndex> inner;
    };

    GlobalDescriptor whitened(const GlobalDescriptor& descriptor) const;
    void learn();
    void fill_next(std::size_t insertions);

    MakeIndex make_inner_;
    std::size_t learn_at_;  ///< frames
    double shrinkage_;
    std::vector<FrameId> frames_;
    std::vector<GlobalDescriptor> descriptors_;  ///< as they came
    Learnt current_;
    std::optional<Learnt> next_;  ///< while it is filled
};

}  // namespace fild
