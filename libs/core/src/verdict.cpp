// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/verdict.h"

#include <algorithm>
#include <array>

namespace fild
{
namespace
{
struct RejectionWords
{
    Rejection rejection;
    const char* word;
    const char* meaning;
};

/** In the order of declaration. */
constexpr std::array<RejectionWords, 14> kRejections = {{
    {Rejection::none, "", "a loop closure: the frame shows the place that its candidate shows"},
    {Rejection::missing_image,
     "missing_image",
     "the image is missing or cannot be read; the frame is skipped"},
    {Rejection::image_size_changed,
     "image_size_changed",
     "the image cannot be scaled to the size of this camera's first image; the frame is skipped"},
    {Rejection::repeated_timestamp,
     "repeated_timestamp",
     "time stamp and image of this camera's frame before; the frame is skipped"},
    {Rejection::unsupported_image,
     "unsupported_image",
     "neither grey nor colour of 8 or 16 bit; the frame is skipped"},
    {Rejection::too_early,
     "too_early",
     "no earlier frame is old enough yet: [index] delay_seconds"},
    {Rejection::no_candidate, "no_candidate", "the index found no candidate"},
    {Rejection::below_similarity,
     "below_similarity",
     "no earlier frame is similar enough: [index] min_similarity"},
    {Rejection::too_few_matches,
     "too_few_matches",
     "fewer matching keypoints than inliers are required"},
    {Rejection::no_model, "no_model", "no motion of the camera explains the matches"},
    {Rejection::too_few_inliers,
     "too_few_inliers",
     "too few matches agree on one motion of the camera: [verification] min_inliers"},
    {Rejection::may_be_chance,
     "may_be_chance",
     "the inliers may agree by chance: support is below [same_place] min_probability"},
    {Rejection::may_be_look_alike,
     "may_be_look_alike",
     "may be two places that look alike: support is below [same_place] min_probability"},
    {Rejection::not_consistent_yet,
     "not_consistent_yet",
     "convincing alone, but not confirmed by the frames around it: [consistency] belief or "
     "consecutive_frames"},
}};

const RejectionWords& words_of(Rejection rejection)
{
    return kRejections.at(static_cast<std::size_t>(rejection));
}
}  // namespace

std::string to_word(Rejection rejection)
{
    return words_of(rejection).word;
}

std::optional<Rejection> rejection_of(const std::string& word)
{
    const auto* found = std::find_if(kRejections.begin(),
                                     kRejections.end(),
                                     [&](const auto& each) { return each.word == word; });
    if (found == kRejections.end()) return std::nullopt;
    return found->rejection;
}

std::string meaning_of(Rejection rejection)
{
    return words_of(rejection).meaning;
}

bool is_unusable(Rejection rejection)
{
    return rejection == Rejection::missing_image || rejection == Rejection::image_size_changed ||
           rejection == Rejection::repeated_timestamp || rejection == Rejection::unsupported_image;
}

const std::vector<Rejection>& all_rejections()
{
    static const std::vector<Rejection> all = []
    {
        std::vector<Rejection> rejections;
        rejections.reserve(kRejections.size());
        for (const auto& each : kRejections) rejections.push_back(each.rejection);
        return rejections;
    }();
    return all;
}

}  // namespace fild
