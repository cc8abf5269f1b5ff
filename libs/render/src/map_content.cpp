// SPDX-License-Identifier: BSD-3-Clause
#include "map_content.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
constexpr double kFarFromOrigin = 10000;  // metres; single precision is then a millimetre
constexpr double kShiftStep = 1000;

void check_finite(const cv::Vec3d& position)
{
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(position[i]))
            throw std::invalid_argument("a map with a position that is not finite");
}

/** Positions in order, a new list where a segment begins. */
std::vector<std::vector<cv::Vec3d>> ways_of(const std::vector<PlacedFrame>& frames)
{
    std::vector<std::vector<cv::Vec3d>> ways;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        if (i == 0 || frames[i].segment != frames[i - 1].segment) ways.emplace_back();
        ways.back().push_back(frames[i].map_from_robot.translation);
    }
    return ways;
}

class Places
{
 public:
    explicit Places(const std::vector<PlacedFrame>& frames)
    {
        for (const auto& frame : frames) places_[frame.frame] = frame.map_from_robot.translation;
    }

    /** Nothing when one of the frames has no place. */
    std::optional<PlacedPair> pair(FrameId query, FrameId candidate) const
    {
        const auto q = places_.find(query);
        const auto c = places_.find(candidate);
        if (q == places_.end() || c == places_.end()) return std::nullopt;
        return PlacedPair{q->second, c->second};
    }

 private:
    std::map<FrameId, cv::Vec3d> places_;
};

/** All positions of a map, to look at or to move. */
std::vector<cv::Vec3d*> positions_of(DrawnMap& map)
{
    std::vector<cv::Vec3d*> all;
    for (auto* frames : {&map.optimized, &map.input})
        for (auto& frame : *frames) all.push_back(&frame.map_from_robot.translation);
    for (auto& position : map.ground_truth) all.push_back(&position);
    for (auto& camera : map.cameras) all.push_back(&camera.map_from_camera.translation);
    return all;
}

/** What brings positions to the origin when one of them is far from it, in whole kilometres. */
cv::Vec3d shift_of(const std::vector<cv::Vec3d*>& positions)
{
    cv::Vec3d shift;
    for (int i = 0; i < 3; ++i)
    {
        double low = (*positions.front())[i];
        double high = low;
        for (const auto* position : positions)
        {
            low = std::min(low, (*position)[i]);
            high = std::max(high, (*position)[i]);
        }
        if (std::max(std::abs(low), std::abs(high)) >= kFarFromOrigin)
            shift[i] = std::round((low + high) / 2 / kShiftStep) * kShiftStep;
    }
    return shift;
}

void put_at_height(double height, PlacedPair& pair)
{
    pair.query[2] = height;
    pair.candidate[2] = height;
}

DrawnMap moved_to_origin(DrawnMap map, cv::Vec3d& shift)
{
    if (map.optimized.empty()) throw std::invalid_argument("a map without a frame that has a pose");
    const auto positions = positions_of(map);
    for (const auto* position : positions) check_finite(*position);
    shift = shift_of(positions);
    for (auto* position : positions) *position -= shift;
    return map;
}
}  // namespace

MapContent::MapContent(const DrawnMap& map, const TRenderOptions& options)
    : picture(options.map_picture_width_px, options.map_picture_height_px),
      loop_colour(options.loop_colour)
{
    auto moved = moved_to_origin(map, shift);
    optimized = ways_of(moved.optimized);
    input = ways_of(moved.input);
    place_loops(moved);
    ground_truth = std::move(moved.ground_truth);
    cameras = std::move(moved.cameras);
    grid = ground_under(points(), plot());
    layer_height = 0.0005 * grid.size();
    for (auto& pair : rejected) put_at_height(grid.height, pair);
}

double MapContent::metres_per_px() const
{
    const double ground = grid.size() / std::max(plot().width, plot().height);
    return unit() * std::max(ground, grid.climb / plot().height);
}

MapContent MapContent::flattened() const
{
    auto flat = *this;
    flat.is_flat = true;
    const double height = grid.height;
    for (auto* ways : {&flat.optimized, &flat.input})
        for (auto& way : *ways)
            for (auto& position : way) position[2] = height;
    for (auto& position : flat.ground_truth) position[2] = height;
    for (auto& loop : flat.loops) put_at_height(height, loop.pair);
    for (auto& pair : flat.unused_loops) put_at_height(height, pair);
    for (auto& place : flat.missed) place[2] = height;
    for (auto& camera : flat.cameras) camera.map_from_camera.translation[2] = height;
    return flat;
}

cv::Size MapContent::plot() const
{
    return {cvRound(0.81 * picture.width), picture.height};
}

MapContent MapContent::for_viewers() const
{
    auto map = *this;
    map.is_for_viewers = true;
    map.layer_height = 0.002 * grid.size();
    return map;
}

const MapStyle& MapContent::truth_style() const
{
    return is_flat ? kTruthBand : kTruthLine;
}

std::vector<cv::Vec3d> MapContent::points() const
{
    auto all = ground_truth;
    for (const auto* ways : {&optimized, &input})
        for (const auto& way : *ways) all.insert(all.end(), way.begin(), way.end());
    return all;
}

void MapContent::place_loops(const DrawnMap& map)
{
    const Places places(map.optimized);
    std::vector<double> values;
    for (const auto& loop : map.loops)
    {
        const auto pair = places.pair(loop.query, loop.candidate);
        if (!pair) continue;
        // A wrong loop is shown as such even where the map has no use for it.
        if (loop.weight > 0 || loop.truth == LoopTruthMark::wrong)
        {
            loops.push_back({*pair, 0, loop.truth});
            const bool by_inliers = loop_colour == LoopColour::inliers;
            values.push_back(by_inliers ? static_cast<double>(loop.inliers) : loop.weight);
        }
        else
            unused_loops.push_back(*pair);
    }
    for (const auto& [query, candidate] : map.rejected)
        if (const auto pair = places.pair(query, candidate)) rejected.push_back(*pair);
    for (const auto frame : map.missed)
        if (const auto pair = places.pair(frame, frame)) missed.push_back(pair->query);
    set_colour_shares(values);
    // The wrong ones are drawn last and hide the others.
    std::stable_partition(loops.begin(),
                          loops.end(),
                          [](const auto& loop) { return loop.truth != LoopTruthMark::wrong; });
}

void MapContent::set_colour_shares(const std::vector<double>& values)
{
    if (loops.empty()) return;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    colour_range = {*low, *high};
    if (loop_colour == LoopColour::weight) colour_range = {0, 1};
    const double range = colour_range[1] - colour_range[0];
    for (std::size_t i = 0; i < loops.size(); ++i)
        loops[i].share = range > 0 ? (values[i] - colour_range[0]) / range : 1;
}

bool MapContent::is_judged() const
{
    return !missed.empty() || count_loops(LoopTruthMark::unknown) < loops.size();
}

std::size_t MapContent::count_loops(LoopTruthMark truth) const
{
    return static_cast<std::size_t>(std::count_if(
        loops.begin(), loops.end(), [&](const auto& loop) { return loop.truth == truth; }));
}

const cv::Scalar& colour_of(LoopTruthMark truth)
{
    static const cv::Scalar right(115, 158, 0);
    static const cv::Scalar wrong(20, 20, 220);
    static const cv::Scalar doubtful(200, 107, 138);
    static const cv::Scalar unknown(130, 130, 130);
    switch (truth)
    {
        case LoopTruthMark::right:
            return right;
        case LoopTruthMark::wrong:
            return wrong;
        case LoopTruthMark::doubtful:
            return doubtful;
        case LoopTruthMark::unknown:
            return unknown;
    }
    return unknown;
}

}  // namespace fild
