// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/render/map_scene.h"
#include "ground_grid.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** A line between two frames' places on the map. */
struct PlacedPair
{
    cv::Vec3d query;
    cv::Vec3d candidate;
};

/** A loop that is an edge of the map, with its colour. */
struct ColouredLoop
{
    PlacedPair pair;
    double share = 0;  ///< of the colour scale, see colour_on_scale()
    LoopTruthMark truth = LoopTruthMark::unknown;
};

/** How the kinds of lines look. */
struct MapStyle
{
    cv::Scalar colour;  ///< BGR
    double width_px = 1;  ///< at a height of 1000
    int layer = 0;  ///< higher ones hide lower ones
};

/** A DrawnMap as it is drawn: placed, coloured and over its grid. */
struct MapContent
{
    MapContent(const DrawnMap& map, const TRenderOptions& options);

    /** What becomes of a length of the style at this size of picture; 1 at a height of 1000. */
    double unit() const { return picture.height / 1000.0; }

    /** How long a pixel of the style is on the map seen from above, metres. */
    double metres_per_px() const;

    /** The part of the picture beside the legend. */
    cv::Size plot() const;

    /** The same map with all heights taken out: everything at the height of the grid. */
    MapContent flattened() const;

    const MapStyle& truth_style() const;

    /** True when the loops are coloured by what the ground truth says of them. */
    bool is_judged() const;

    std::size_t count_loops(LoopTruthMark truth) const;

    /** The same map for a file that others show: their depths are less exact, so that layers must
     *  be further apart. */
    MapContent for_viewers() const;

    /** All that a view must show. */
    std::vector<cv::Vec3d> points() const;

    cv::Size picture;  ///< pixels
    cv::Vec3d shift;  ///< was taken from all positions, metres
    GroundGrid grid;
    std::vector<std::vector<cv::Vec3d>> optimized;  ///< by segment
    std::vector<std::vector<cv::Vec3d>> input;
    std::vector<cv::Vec3d> ground_truth;
    std::vector<ColouredLoop> loops;
    std::vector<PlacedPair> unused_loops;
    std::vector<cv::Vec3d> missed;  ///< places of loop queries that were rejected
    std::vector<PlacedPair> rejected;  ///< on the ground, where they hide no path
    std::vector<DrawnCamera> cameras;
    bool is_flat = false;
    bool is_for_viewers = false;
    double layer_height = 0;  ///< of each layer of MapStyle above the one below it, metres
    LoopColour loop_colour = LoopColour::inliers;
    std::array<double, 2> colour_range{};  ///< inliers or weight of the first and last colour

 private:
    void place_loops(const DrawnMap& map);
    void set_colour_shares(const std::vector<double>& values);
};

/** The colour of loops of which the truth says so. */
const cv::Scalar& colour_of(LoopTruthMark truth);

const MapStyle kGridStyle{{205, 205, 205}, 1, 0};
const MapStyle kTruthBand{{120, 205, 250}, 8, 1};  // shows where others leave it
const MapStyle kTruthLine{{0, 159, 230}, 1.5, 1};  // hides nothing that is lower
const MapStyle kRejectedStyle{{220, 195, 230}, 1, 2};
const MapStyle kInputStyle{{233, 180, 86}, 2.5, 3};
const MapStyle kOptimizedStyle{{45, 40, 35}, 3, 4};
const MapStyle kUnusedStyle{{150, 40, 205}, 2.5, 5};
const MapStyle kLoopStyle{{}, 2.5, 6};
const MapStyle kCameraStyle{{110, 90, 80}, 1, 7};
const MapStyle kMarkStyle{{}, 15, 8};
constexpr double kLoopSpot_px = 7;
const MapStyle kMissedStyle{{60, 60, 60}, 10, 7};  // a ring
const cv::Scalar kStartColour(178, 114, 0);
const cv::Scalar kEndColour(0, 94, 213);

}  // namespace fild
