// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "nearest_two.h"

#include <vector>

namespace fild
{
/** For each code of the query the two nearest of the candidate that it was compared with, and the
 *  reverse. */
struct Meetings
{
    std::vector<NearestTwo> of_query;
    std::vector<NearestTwo> of_candidate;
};

/** Compares a keypoint of the query with those keypoints of the candidate that stand where the
 *  network's cells say that it has moved to; with none where no cells near it agree. */
Meetings meetings_by_cells(const HashedFeatures& query, const HashedFeatures& candidate);

}  // namespace fild
