// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/verdict.h"

namespace fild
{
std::string to_word(Rejection rejection)
{
    switch (rejection)
    {
        case Rejection::none:
            return "";
        case Rejection::missing_image:
            return "missing_image";
        case Rejection::image_size_changed:
            return "image_size_changed";
        case Rejection::repeated_timestamp:
            return "repeated_timestamp";
        case Rejection::unsupported_image:
            return "unsupported_image";
        case Rejection::too_early:
            return "too_early";
        case Rejection::no_candidate:
            return "no_candidate";
        case Rejection::below_similarity:
            return "below_similarity";
        case Rejection::too_few_matches:
            return "too_few_matches";
        case Rejection::no_model:
            return "no_model";
        case Rejection::too_few_inliers:
            return "too_few_inliers";
        case Rejection::may_be_chance:
            return "may_be_chance";
        case Rejection::may_be_look_alike:
            return "may_be_look_alike";
        case Rejection::not_consistent_yet:
            return "not_consistent_yet";
    }
    return "";
}

bool is_unusable(Rejection rejection)
{
    return rejection == Rejection::missing_image || rejection == Rejection::image_size_changed ||
           rejection == Rejection::repeated_timestamp || rejection == Rejection::unsupported_image;
}

const std::vector<Rejection>& all_rejections()
{
    static const std::vector<Rejection> all = {
        Rejection::none,
        Rejection::missing_image,
        Rejection::image_size_changed,
        Rejection::repeated_timestamp,
        Rejection::unsupported_image,
        Rejection::too_early,
        Rejection::no_candidate,
        Rejection::below_similarity,
        Rejection::too_few_matches,
        Rejection::no_model,
        Rejection::too_few_inliers,
        Rejection::may_be_chance,
        Rejection::may_be_look_alike,
        Rejection::not_consistent_yet,
    };
    return all;
}

}  // namespace fild
