// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/map_scene.h"

#include "fild/core/whole_file.h"
#include "fild/render/offscreen_renderer.h"
#include "framing.h"
#include "map_legend.h"
#include "map_objects.h"
#include "scene_objects.h"

#include <mrpt/opengl/CText.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace fild
{
namespace
{
const double kNorth = CV_PI / 2;  // the heading of the y axis

/** The corners of the ground, and the map. */
std::vector<cv::Vec3d> points_to_show(const MapContent& map)
{
    auto points = map.points();
    const auto& area = map.grid.area;
    for (const double x : {area.x, area.br().x})
        for (const double y : {area.y, area.br().y}) points.emplace_back(x, y, map.grid.height);
    return points;
}

/** Near and far enough for all of the map, lifted layers and cameras included. */
ClipRange clip_range(const MapContent& map, const PictureView& view)
{
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    const auto camera_from_map = view.map_from_camera.inverse();
    for (const auto& point : points_to_show(map))
    {
        const double depth = (camera_from_map * point)[2];
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const double around = 0.1 * map.grid.size();
    return {std::max(nearest - around, 0.1 * nearest), farthest + around};
}

/** Draws the map as a view sees it, with the legend. */
MapPicture draw_map(const MapContent& map, const Framing& framing, const std::string& title)
{
    MapPicture picture;
    picture.view = framed_view(framing);
    OffscreenRenderer renderer(make_scene(map), clip_range(map, picture.view));
    const auto plot =
        renderer.draw_image(picture.view.camera, to_mrpt(picture.view.map_from_camera));
    picture.image = cv::Mat(map.picture, CV_8UC3, cv::Scalar::all(255));
    plot.copyTo(picture.image(cv::Rect({0, 0}, plot.size())));
    draw_labels(picture.image, map, picture.view);
    draw_legend(picture.image, map, title);
    picture.view.camera.width = map.picture.width;
    picture.view.map_from_camera.translation += map.shift;
    return picture;
}

/** The part of the plot that is left beside labels at its left and lower border. */
cv::Rect2d beside_labels(const MapContent& map)
{
    const double margin = 20 * map.unit();
    const cv::Size2d labels = label_size(map);
    const cv::Size2d plot = map.plot();
    return {labels.width + margin / 2,
            margin,
            plot.width - labels.width - 1.5 * margin,
            plot.height - labels.height - 1.5 * margin};
}

void add_name(mrpt::opengl::COpenGLScene& scene, const std::string& text, const cv::Vec3d& at)
{
    auto label = mrpt::opengl::CText::Create(" " + text);
    label->setLocation(at[0], at[1], at[2]);
    label->setColor_u8({40, 45, 50});
    scene.insert(label);
}
}  // namespace

cv::Point2d MapPicture::project(const cv::Vec3d& in_map) const
{
    return view.project({in_map[0], in_map[1], drawn_height.value_or(in_map[2])});
}

MapScene::MapScene(const DrawnMap& map, const TRenderOptions& options)
    : content_(std::make_unique<const MapContent>(map, options))
{
}

MapScene::~MapScene() = default;

MapPicture MapScene::draw_from_above() const
{
    const auto flat = content_->flattened();
    Framing framing;
    framing.points = points_to_show(flat);
    framing.map_from_camera = looking_down(flat.grid.is_turned ? 0 : kNorth, CV_PI / 2);
    framing.size = flat.plot();
    framing.inside = beside_labels(flat);
    framing.focal_px = 20.0 * framing.size.width;
    auto picture = draw_map(flat, framing, "Map from above");
    picture.drawn_height = flat.grid.height + flat.shift[2];
    return picture;
}

MapPicture MapScene::draw_in_perspective() const
{
    constexpr double kAside = 0.36;  // rad; seen along an axis, one family of lines is upright
    constexpr double kPitch = 0.8;
    Framing framing;
    framing.points = points_to_show(*content_);
    framing.map_from_camera =
        looking_down((content_->grid.is_turned ? 0 : kNorth) - kAside, kPitch);
    framing.size = content_->plot();
    framing.inside = beside_labels(*content_);
    framing.focal_px = 1.3 * framing.size.width;
    framing.nearest_m = 0.05 * content_->grid.size();
    return draw_map(*content_, framing, "Map in perspective");
}

void MapScene::save(const std::string& path) const
{
    const auto map = content_->for_viewers();
    auto scene = make_scene(map);
    // Which objects are unlit is not stored: light the same from all sides leaves colours as they
    // are.
    auto& light = scene->getViewport()->lightParameters();
    light.ambient = {1, 1, 1};
    light.diffuse = light.specular = {0, 0, 0};
    add_name(*scene, "start", start_mark(map));
    add_name(*scene, "end", end_mark(map));
    WholeFile file(path);
    if (!scene->saveToFile(file.temporary_path()))
        throw std::runtime_error("cannot write " + path + "; is the disk full?");
    file.commit();
}

}  // namespace fild
