// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fild::testing
{
/** Points into the features that were matched, which must outlive it. */
struct DescriptorMatch
{
    const Keypoint* query = nullptr;
    const Keypoint* candidate = nullptr;
};

/** Where it is more than `at_most`, some other number that is, too. */
inline double squared_distance(const float* a, const float* b, double at_most)
{
    float sum = 0;
    for (std::size_t i = 0; i < LocalFeatures::dimension && sum <= at_most; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/** Nearest neighbours of the queries among the candidates, by exhaustive search, kept when nearest
 *  <= ratio * second nearest (Lowe). ratio = 1 keeps all. */
inline std::vector<DescriptorMatch> match_by_ratio(const LocalFeatures& queries,
                                                   const LocalFeatures& candidates,
                                                   double ratio)
{
    std::vector<DescriptorMatch> matches;
    for (std::size_t q = 0; q < queries.size(); ++q)
    {
        double best = std::numeric_limits<double>::max();
        double second = best;
        const Keypoint* nearest = nullptr;
        for (std::size_t c = 0; c < candidates.size(); ++c)
        {
            const auto& candidate = candidates.keypoints[c];
            const double distance =
                squared_distance(queries.descriptor(q), candidates.descriptor(c), second);
            if (distance < best)
            {
                second = best;
                best = distance;
                nearest = &candidate;
            }
            else
                second = std::min(second, distance);
        }
        if (nearest != nullptr && best <= ratio * ratio * second)
            matches.push_back({&queries.keypoints[q], nearest});
    }
    return matches;
}

/** Number of matches whose query, moved by `place`, is at most `tolerance` pixels off. */
template <class Place>
std::size_t count_correct(const std::vector<DescriptorMatch>& matches,
                          const Place& place,
                          double tolerance)
{
    std::size_t correct = 0;
    for (const auto& match : matches)
    {
        const auto expected = place(match.query->x, match.query->y);
        const double error =
            std::hypot(expected.x - match.candidate->x, expected.y - match.candidate->y);
        correct += error <= tolerance ? 1U : 0U;
    }
    return correct;
}

}  // namespace fild::testing
