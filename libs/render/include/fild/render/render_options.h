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

/** What the colour of a loop closure on the map tells. */
enum class LoopColour
{
    inliers,
    weight  ///< in the optimised graph
};

/** Section [render]. */
struct TRenderOptions : Options
{
    bool enabled = true;  ///< false: no picture at all
    int max_match_pictures = 100;  ///< 0: none
    PictureChoice match_picture_choice = PictureChoice::spread;
    int match_picture_width_px = 1400;
    int max_match_lines = 120;  ///< in a picture; all matches have their marks
    bool draw_rejected_matches = false;  ///< that passed the ratio test and are no inliers
    bool match_pictures_3d = false;  ///< also, for loops with a metric pose

    bool write_map_pictures = true;
    int map_picture_width_px = 1600;
    int map_picture_height_px = 1000;
    LoopColour loop_colour = LoopColour::inliers;
    int max_rejected_pairs = 20;  ///< on the map, those with most support
    int max_map_cameras = 40;  ///< frusta on the map, evenly over the keyframes; 0: none
    bool camera_images = false;  ///< in the frusta

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Indices of the loop closures to draw, ascending; equals by index. Deterministic. Thread-safe. */
std::vector<std::size_t> choose_match_pictures(const std::vector<FrameVerdict>& loops,
                                               const TRenderOptions& options);

}  // namespace fild
