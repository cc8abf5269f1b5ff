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

std::string meaning_of(Rejection rejection)
{
    switch (rejection)
    {
        case Rejection::none:
            return "a loop closure: the frame shows the place that its candidate shows";
        case Rejection::missing_image:
            return "the image is missing or cannot be read; the frame is skipped";
        case Rejection::image_size_changed:
            return "the image cannot be scaled to the size of this camera's first image; the frame "
                   "is skipped";
        case Rejection::repeated_timestamp:
            return "time stamp and image of this camera's frame before; the frame is skipped";
        case Rejection::unsupported_image:
            return "neither grey nor colour of 8 or 16 bit; the frame is skipped";
        case Rejection::too_early:
            return "no earlier frame is old enough yet: [index] delay_seconds";
        case Rejection::no_candidate:
            return "the index found no candidate";
        case Rejection::below_similarity:
            return "no earlier frame is similar enough: [index] min_similarity";
        case Rejection::too_few_matches:
            return "fewer matching keypoints than inliers are required";
        case Rejection::no_model:
            return "no motion of the camera explains the matches";
        case Rejection::too_few_inliers:
            return "too few matches agree on one motion of the camera: [verification] min_inliers";
        case Rejection::may_be_chance:
            return "the inliers may agree by chance: support is below [same_place] min_probability";
        case Rejection::may_be_look_alike:
            return "may be two places that look alike: support is below [same_place] "
                   "min_probability";
        case Rejection::not_consistent_yet:
            return "convincing alone, but not confirmed by the frames around it: [consistency] "
                   "belief "
                   "or consecutive_frames";
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
