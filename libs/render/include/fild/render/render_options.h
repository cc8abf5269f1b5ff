// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/core/verdict.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** Which loop closures get a match picture when there are more than the limit. */
enum class PictureChoice
{
    spread,  ///< evenly over the run
    weakest,  ///< those with the fewest inliers: where a false loop would be
    strongest,
    first
};

/** Section [render]. */
struct TRenderOptions : Options
{
    int max_match_pictures = 100;  ///< 0: none
    PictureChoice match_picture_choice = PictureChoice::spread;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Indices of the loop closures to draw, ascending; equals by index. Deterministic. Thread-safe. */
std::vector<std::size_t> choose_match_pictures(const std::vector<FrameVerdict>& loops,
                                               const TRenderOptions& options);

}  // namespace fild
