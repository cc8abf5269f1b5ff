// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** Vertices of which each is joined to each. Value type. */
struct Clique
{
    std::vector<std::size_t> vertices;  ///< in increasing order
    /** No clique has more vertices than this; equal to their number when it was proven that there
     *  is no larger one. */
    std::size_t upper_bound = 0;
};

/** The largest clique of an undirected graph; of several, always the same one.
 *
 *  Branch and bound over greedy colourings, with sets as bit strings (San Segundo et al., "An exact
 *  bit-parallel algorithm for the maximum clique problem", 2011), begun with a greedy clique. Cost
 *  is exponential at worst, so it ends after `max_steps` branches with the best clique so far.
 *  \param adjacency  symmetric, square; its diagonal is not looked at.
 *  \param check_cancelled  called before each branch.
 *  \throw std::invalid_argument when it is not square or not symmetric. Deterministic. */
Clique largest_clique(const std::vector<std::vector<bool>>& adjacency,
                      const CheckCancelled& check_cancelled = never_cancelled,
                      std::size_t max_steps = 20000);

}  // namespace fild
