// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

namespace fild
{
/** How descriptors are searched. */
enum class IndexBackend
{
    hnsw,  ///< proximity graph, approximate, sub-linear (the paper's)
    exact  ///< linear scan
};

/** Section [index]: which earlier frames may answer, and how they are searched. */
struct TIndexOptions : Options
{
    /** psi: a frame can be a candidate only when it is at least this old. Seconds. */
    double delay_seconds = 40;
    /** phi, frames a second of one camera: when positive the delay is psi x phi frames, as the
     *  paper counts it, whatever the time stamps say. 0: the delay is measured by time stamps. */
    double frame_rate = 0;
    /** A camera that has shown the same view for so long, seconds, stands still: its frames are no
     *  candidates, and the delay waits until it moves. Else a robot that stops for longer than the
     *  delay returns to itself at every frame. 0: it is not looked at, as in the paper. */
    double still_seconds = 0;
    /** n: how many nearest neighbours are verified. */
    int candidates = 1;
    /** Neighbours less similar than this are not verified; cosine. The paper has no such bound. */
    double min_similarity = -1;
    /** From so many frames in the map on, descriptors are compared after what all of them have in
     *  common has been taken out, see WhitenedIndex. The first answer is a true place for 0.72,
     * 0.77 and 0.77 of the loop queries of the synthetic town (seeds 1 to 3) without it, for 0.86,
     * 0.87 and 0.91 with it. 0: never, as in the paper. */
    int whiten_from = 0;
    /** So many times the mean variance is added to each variance when that is learnt: the more, the
     *  less is taken out. */
    double whitening_shrinkage = 10;
    IndexBackend backend = IndexBackend::hnsw;
    int links_per_node =
        48;  ///< M of the HNSW graph, links of a node in each layer above the lowest
    int construction_width = 40;  ///< ef while a node is inserted
    int search_width = 40;  ///< ef while the graph is searched; at least `candidates`

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
