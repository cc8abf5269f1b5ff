// SPDX-License-Identifier: BSD-3-Clause
#include "map_objects.h"

#include "colour_scale.h"
#include "scene_objects.h"

#include <algorithm>

namespace fild
{
namespace
{
constexpr int kRound = 16;  // corners of a spot that looks round
constexpr int kSquare = 4;

/** An arrow from a camera at `from` to where it looks.
 *  \return false, and adds none, when that is up or down. */
bool add_level_arrow(ThinLines& lines,
                     const cv::Vec3d& from,
                     const cv::Matx33d& map_from_camera,
                     double length)
{
    const cv::Vec3d ahead(map_from_camera(0, 2), map_from_camera(1, 2), 0);
    constexpr double kLeast = 0.1;
    if (cv::norm(ahead) < kLeast) return false;
    const auto along = cv::normalize(ahead);
    const cv::Vec3d aside(-along[1], along[0], 0);
    const auto tip = from + length * along;
    lines.add(from, tip);
    for (const double side : {-1.0, 1.0})
        lines.add(tip, tip - 0.3 * length * along + side * 0.2 * length * aside);
    return true;
}

/** Puts the objects of a map into a scene, each kind on its layer. */
class MapObjects
{
 public:
    explicit MapObjects(const MapContent& map)
        : map_(map), metre_(map.metres_per_px()), scene_(empty_scene())
    {
    }

    void add_grid();
    void add_way(const std::vector<cv::Vec3d>& way, const MapStyle& style, const char* name);
    void add_arrows(const std::vector<cv::Vec3d>& way);
    void add_rejected();
    void add_loops();
    void add_missed();
    void add_cameras();
    void add_marks();

    mrpt::opengl::COpenGLScene::Ptr scene() const { return scene_; }

 private:
    cv::Vec3d lifted(const cv::Vec3d& position, const MapStyle& style) const
    {
        return position + cv::Vec3d(0, 0, style.layer * map_.layer_height);
    }

    void add_pair(Strokes& strokes,
                  const PlacedPair& pair,
                  const MapStyle& style,
                  const cv::Scalar& colour) const;

    const MapContent& map_;
    double metre_;  ///< per pixel
    mrpt::opengl::COpenGLScene::Ptr scene_;
};

void MapObjects::add_grid()
{
    const auto& grid = map_.grid;
    ThinLines lines(kGridStyle.colour);
    for (const double x : grid.lines_of_x())
        lines.add({x, grid.area.y, grid.height}, {x, grid.area.br().y, grid.height});
    for (const double y : grid.lines_of_y())
        lines.add({grid.area.x, y, grid.height}, {grid.area.br().x, y, grid.height});
    scene_->insert(lines.make("grid"));
}

void MapObjects::add_way(const std::vector<cv::Vec3d>& way, const MapStyle& style, const char* name)
{
    if (way.empty()) return;
    constexpr double kShortest_px = 0.5;  // what is shorter is not seen
    const double width = style.width_px * metre_;
    Strokes strokes;
    auto last = way.front();
    for (const auto& position : way)
    {
        const bool is_end = &position == &way.back();
        const double length = cv::norm(position - last);
        if (length == 0 || (length < kShortest_px * metre_ && !is_end)) continue;
        strokes.add_line(lifted(last, style), lifted(position, style), width, style.colour);
        strokes.add_spot(lifted(position, style), width, kRound / 2, style.colour);
        last = position;
    }
    strokes.add_spot(lifted(way.front(), style), width, kRound / 2, style.colour);
    scene_->insert(strokes.make(name));
}

/** Heads on the path that point the way it was driven. */
void MapObjects::add_arrows(const std::vector<cv::Vec3d>& way)
{
    constexpr double kLength_px = 17;
    const double spacing = map_.grid.size() / 9;
    Strokes heads;
    double since_last = spacing / 2;
    for (std::size_t i = 1; i < way.size(); ++i)
    {
        auto along = way[i] - way[i - 1];
        along[2] = 0;
        const double step = cv::norm(along);
        since_last += step;
        if (since_last < spacing || step < 1e-6 * spacing) continue;
        since_last = 0;
        heads.add_arrowhead(lifted(way[i], kOptimizedStyle),
                            along / step,
                            kLength_px * metre_,
                            kOptimizedStyle.colour);
    }
    scene_->insert(heads.make("direction of travel"));
}

void MapObjects::add_rejected()
{
    if (map_.rejected.empty()) return;
    ThinLines lines(kRejectedStyle.colour);
    for (const auto& pair : map_.rejected)
        lines.add(lifted(pair.query, kRejectedStyle), lifted(pair.candidate, kRejectedStyle));
    scene_->insert(lines.make("rejected pairs"));
}

void MapObjects::add_pair(Strokes& strokes,
                          const PlacedPair& pair,
                          const MapStyle& style,
                          const cv::Scalar& colour) const
{
    const auto query = lifted(pair.query, style);
    const auto candidate = lifted(pair.candidate, style);
    if (cv::norm(query - candidate) > 0)
        strokes.add_line(query, candidate, style.width_px * metre_, colour);
    // Where the second visit takes the way of the first, the spots are all that is seen.
    for (const auto& end : {query, candidate})
        strokes.add_spot(end, kLoopSpot_px * metre_, kRound, colour);
}

void MapObjects::add_loops()
{
    Strokes unused;
    for (const auto& pair : map_.unused_loops)
        add_pair(unused, pair, kUnusedStyle, kUnusedStyle.colour);
    if (!map_.unused_loops.empty()) scene_->insert(unused.make("loops not used"));
    Strokes used;
    for (const auto& [pair, share, truth] : map_.loops)
        add_pair(
            used, pair, kLoopStyle, map_.is_judged() ? colour_of(truth) : colour_on_scale(share));
    if (!map_.loops.empty()) scene_->insert(used.make("loops"));
}

void MapObjects::add_missed()
{
    if (map_.missed.empty()) return;
    const double width = kMissedStyle.width_px * metre_;
    const cv::Vec3d above(0, 0, map_.layer_height / 2);
    Strokes rings;
    for (const auto& place : map_.missed)
    {
        const auto at = lifted(place, kMissedStyle);
        rings.add_spot(at, width, kRound, kMissedStyle.colour);
        rings.add_spot(at + above, 0.6 * width, kRound, cv::Scalar::all(255));
    }
    scene_->insert(rings.make("missed loops"));
}

void MapObjects::add_cameras()
{
    if (map_.cameras.empty()) return;
    const double width =
        map_.grid.size() * std::clamp(1.5 / static_cast<double>(map_.cameras.size()), 0.02, 0.06);
    ThinLines frusta(kCameraStyle.colour);
    ImageWall images;
    for (const auto& [map_from_camera, camera, image] : map_.cameras)
    {
        const double distance = width * camera.fx / camera.width;
        const auto corners = image_corners(camera, map_from_camera, distance);
        // A frustum from above looks like an arrowhead that points back.
        const auto above_grid = lifted(map_from_camera.translation, kCameraStyle);
        if (!map_.is_flat ||
            !add_level_arrow(frusta, above_grid, map_from_camera.rotation, distance))
            frusta.add_frustum(map_from_camera.translation, corners);
        if (!image.empty()) images.add(image, corners);
    }
    scene_->insert(frusta.make("cameras"));
    constexpr int kWidestImage = 400;
    if (images.empty()) return;
    if (map_.is_for_viewers)
        images.insert_planes(kWidestImage, *scene_);
    else
        scene_->insert(images.make(kWidestImage, "camera images"));
}

void MapObjects::add_marks()
{
    const double width = kMarkStyle.width_px * metre_;
    const cv::Vec3d above(0, 0, map_.layer_height / 2);
    const auto white = cv::Scalar::all(255);
    const auto add = [&](const cv::Vec3d& place, int corners, const cv::Scalar& colour, auto name)
    {
        Strokes mark;
        mark.add_spot(place, 1.4 * width, corners, white);
        mark.add_spot(place + above, width, corners, colour);
        scene_->insert(mark.make(name));
    };
    add(start_mark(map_), kRound, kStartColour, "start");
    add(end_mark(map_), kSquare, kEndColour, "end");
}
}  // namespace

cv::Vec3d start_mark(const MapContent& map)
{
    return map.optimized.front().front() + cv::Vec3d(0, 0, kMarkStyle.layer * map.layer_height);
}

cv::Vec3d end_mark(const MapContent& map)
{
    const double layer = kMarkStyle.layer + 1;  // the end hides the start, not half of it
    return map.optimized.back().back() + cv::Vec3d(0, 0, layer * map.layer_height);
}

mrpt::opengl::COpenGLScene::Ptr make_scene(const MapContent& map)
{
    MapObjects objects(map);
    objects.add_grid();
    objects.add_way(map.ground_truth, map.truth_style(), "ground truth");
    objects.add_rejected();
    for (const auto& way : map.input) objects.add_way(way, kInputStyle, "path before the loops");
    for (const auto& way : map.optimized) objects.add_way(way, kOptimizedStyle, "optimised path");
    for (const auto& way : map.optimized) objects.add_arrows(way);
    objects.add_loops();
    objects.add_missed();
    objects.add_cameras();
    objects.add_marks();
    return objects.scene();
}

}  // namespace fild
