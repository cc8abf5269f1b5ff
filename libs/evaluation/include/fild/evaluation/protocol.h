// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace fild
{
/** How a loop closure is compared with the truth. Value type. */
struct Protocol
{
    enum class Kind
    {
        exact,  ///< labels: the pair (query, candidate) is labelled
        window,  ///< labels: a pair of the same query is, whose candidate is at most `window` away
        radius  ///< poses: they are near each other, see below
    };

    Kind kind = Kind::exact;
    std::size_t window = 0;  ///< frames; 10 and 40 are in use in publications
    double radius = 0;  ///< metres between the positions
    /** Metres, above `radius`; 0: off. Pairs up to this distance and twice max_angle_deg that are
     *  not right are not wrong either: both frames may show the same things from further off. */
    double doubtful_radius = 0;
    double max_angle_deg = 45;  ///< of the rotation between the two poses: the same view
    double min_age_seconds = 30;  ///< of the candidate when the query was taken: a return, no stay
};

/** Reads `exact`, `window:N` (N >= 1), `radius:R` (R > 0) or `radius:R,D` (D > R, doubtful_radius).
 *  \throw std::invalid_argument quoting the word. */
Protocol parse_protocol(const std::string& word);

/** The word that parse_protocol() reads. */
std::string to_word(const Protocol& protocol);

/** One sentence: when a loop closure is right under this protocol. */
std::string rule_of(const Protocol& protocol);

}  // namespace fild
