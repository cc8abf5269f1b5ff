// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/town.h"

#include "cars.h"
#include "ground.h"
#include "houses.h"
#include "road_user_scene.h"
#include "sky.h"
#include "street_furniture.h"
#include "textured_mesh.h"
#include "town_plan.h"
#include "trees.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
/** A part of the ground that has a picture of its own. */
struct GroundTile
{
    cv::Rect2d area;
    cv::Mat picture;  ///< in the sun
};

/** Where the ground is cut: at the middle of every street and at the outer house fronts. */
std::vector<double> cuts(int blocks, double pitch, double margin)
{
    std::vector<double> at{-margin};
    for (int i = 0; i <= blocks; ++i) at.push_back(i * pitch);
    at.push_back(blocks * pitch + margin);
    return at;
}

std::vector<GroundTile> paint_tiles(const TownPlan& plan, std::uint64_t seed)
{
    const auto& grid = plan.grid;
    const auto margin = grid.street_width() / 2;
    const auto along_x = cuts(grid.columns, grid.block_length + grid.street_width(), margin);
    const auto along_y = cuts(grid.rows, grid.block_width + grid.street_width(), margin);
    std::vector<GroundTile> tiles;
    for (std::size_t i = 0; i + 1 < along_x.size(); ++i)
        for (std::size_t j = 0; j + 1 < along_y.size(); ++j)
        {
            const cv::Rect2d area(cv::Point2d(along_x[i], along_y[j]),
                                  cv::Point2d(along_x[i + 1], along_y[j + 1]));
            tiles.push_back({area, paint_ground(plan, area, seed + tiles.size())});
        }
    return tiles;
}

/** A level rectangle that shows its part of the tile's picture, whose outermost half pixels are
 *  left out: beyond them it would be mixed with the opposite edge. */
void add_level(TexturedMesh& mesh, const cv::Rect2d& metres, double height, const GroundTile& tile)
{
    const auto& area = tile.area;
    const auto inside = [](double share, int size) { return (share * (size - 1) + 0.5) / size; };
    const auto corner = [&](double x, double y)
    {
        return Corner{{x, y, height},
                      {inside((x - area.x) / area.width, tile.picture.cols),
                       inside((area.y + area.height - y) / area.height, tile.picture.rows)}};
    };
    const auto right = metres.x + metres.width;
    const auto top = metres.y + metres.height;
    mesh.add_quad(corner(metres.x, metres.y),
                  corner(right, metres.y),
                  corner(right, top),
                  corner(metres.x, top));
}

cv::Rect2d with_margin(const cv::Rect2d& metres, double margin)
{
    return {metres.x - margin,
            metres.y - margin,
            metres.width + 2 * margin,
            metres.height + 2 * margin};
}

/** The upright faces of the kerb around a pavement, seen from outside or from inside of it. */
void add_kerb(TexturedMesh& mesh, const cv::Rect2d& edge, bool from_outside)
{
    const std::array<cv::Point2d, 4> corners{edge.tl(),
                                             cv::Point2d(edge.x + edge.width, edge.y),
                                             edge.br(),
                                             cv::Point2d(edge.x, edge.y + edge.height)};
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        auto a = corners[i];
        auto b = corners[(i + 1) % corners.size()];
        if (!from_outside) std::swap(a, b);
        mesh.add_panel({cv::Point3d(a.x, a.y, 0),
                        cv::Point3d(b.x, b.y, 0),
                        cv::Point3d(b.x, b.y, kKerbHeight),
                        cv::Point3d(a.x, a.y, kKerbHeight)},
                       {0, 0, cv::norm(b - a), 1});
    }
}

cv::Mat paint_kerb()
{
    Lot lot(81);
    cv::Mat kerb(12, 100, CV_8UC3, cv::Scalar(150, 155, 158));
    cv::rectangle(kerb, {0, 0, 3, 12}, {90, 95, 98}, cv::FILLED);
    add_grain(kerb, 8, lot);
    return kerb;
}

cv::Point3d towards_sun(const LapConditions& conditions)
{
    return {std::cos(conditions.sun_elevation) * std::cos(conditions.sun_azimuth),
            std::cos(conditions.sun_elevation) * std::sin(conditions.sun_azimuth),
            std::sin(conditions.sun_elevation)};
}

/** Roads, and the pavements over them. */
void add_ground(mrpt::opengl::COpenGLScene& scene,
                const TownPlan& plan,
                const std::vector<GroundTile>& tiles,
                const LapConditions& conditions)
{
    const auto sun = towards_sun(conditions);
    const auto& grid = plan.grid;
    const auto outer_kerb = with_margin(grid.bounds(), -grid.pavement);
    for (const auto& tile : tiles)
    {
        TexturedMesh mesh;
        add_level(mesh, tile.area, 0, tile);
        for (int i = 0; i < grid.columns; ++i)
            for (int j = 0; j < grid.rows; ++j)
                if (const auto part = with_margin(grid.block(i, j), grid.pavement) & tile.area;
                    part.area() > 0)
                    add_level(mesh, part, kKerbHeight, tile);
        const auto bounds = grid.bounds();
        const auto right = outer_kerb.x + outer_kerb.width;
        const auto top = outer_kerb.y + outer_kerb.height;
        for (const auto& strip :
             {cv::Rect2d(bounds.x, bounds.y, bounds.width, grid.pavement),
              cv::Rect2d(bounds.x, top, bounds.width, grid.pavement),
              cv::Rect2d(bounds.x, outer_kerb.y, grid.pavement, outer_kerb.height),
              cv::Rect2d(right, outer_kerb.y, grid.pavement, outer_kerb.height)})
            if (const auto part = strip & tile.area; part.area() > 0)
                add_level(mesh, part, kKerbHeight, tile);
        auto picture = tile.picture.clone();
        if (conditions.season > 0) weather_ground(picture, tile.area, plan, conditions.season);
        cast_shadows(picture, tile.area, plan, cv::Point2d(-sun.x, -sun.y) / sun.z);
        scene.insert(mesh.object(picture));
    }
    TexturedMesh kerbs;
    for (int i = 0; i < grid.columns; ++i)
        for (int j = 0; j < grid.rows; ++j)
            add_kerb(kerbs, with_margin(grid.block(i, j), grid.pavement), true);
    add_kerb(kerbs, outer_kerb, false);
    scene.insert(kerbs.object(paint_kerb()));
}

/** But for the exposure and the road users. */
bool same_scene(const LapConditions& a, const LapConditions& b)
{
    return a.sun_azimuth == b.sun_azimuth && a.sun_elevation == b.sun_elevation &&
           a.parked_cars == b.parked_cars && a.season == b.season;
}
}  // namespace

struct Town::Parts
{
    TownPlan plan;
    std::vector<RowPicture> rows;
    std::vector<GroundTile> ground;
    /** The scene as it is under `built_for`. */
    std::optional<LapConditions> built_for;
    mrpt::opengl::CSetOfTexturedTriangles::Ptr sky;
    std::unique_ptr<OffscreenRenderer> renderer;
    // Scenes give back what they hold in the renderer's context, so they must go before it.
    std::shared_ptr<mrpt::opengl::COpenGLScene> scene;
    std::unique_ptr<RoadUserScene> road_users;  ///< once there is one in the scene

    void build(const LapConditions& conditions);
    void show(const std::vector<RoadUser>& users);
};

void Town::Parts::build(const LapConditions& conditions)
{
    road_users.reset();
    scene.reset();
    renderer.reset();
    scene = std::make_shared<mrpt::opengl::COpenGLScene>();
    scene->getViewport()->setCustomBackgroundColor({0.62F, 0.66F, 0.60F});  // fields around
    const auto sun = towards_sun(conditions);
    auto& light = scene->getViewport()->lightParameters();
    light.ambient = {0.62F, 0.62F, 0.62F};
    light.diffuse = {0.55F, 0.53F, 0.48F};
    light.direction = {
        static_cast<float>(-sun.x), static_cast<float>(-sun.y), static_cast<float>(-sun.z)};
    add_ground(*scene, plan, ground, conditions);
    add_houses(*scene, plan, rows);
    add_trees(*scene, plan.trees, conditions.season);
    add_lamp_posts(*scene, plan.lamp_posts);
    add_cars(*scene, parked_cars(plan, conditions.parked_cars));
    sky = sky_dome(conditions.parked_cars);
    scene->insert(sky);
    renderer = std::make_unique<OffscreenRenderer>(scene);
    built_for = conditions;
}

void Town::Parts::show(const std::vector<RoadUser>& users)
{
    if (users.empty() && !road_users) return;
    if (!road_users)
    {
        road_users = std::make_unique<RoadUserScene>();
        road_users->insert_into(*scene);
    }
    road_users->show(users);
}

Town::Town(const TTownOptions& options) : parts_(std::make_unique<Parts>())
{
    options.check();
    parts_->plan = plan_town(options);
    for (const auto& row : parts_->plan.rows) parts_->rows.push_back(paint_row(row));
    parts_->ground = paint_tiles(parts_->plan, static_cast<std::uint64_t>(options.seed));
}

Town::~Town() = default;

const StreetGrid& Town::grid() const
{
    return parts_->plan.grid;
}

RenderedView Town::draw(const CameraModel& camera,
                        const mrpt::poses::CPose3D& map_from_camera,
                        const LapConditions& conditions)
{
    if (!parts_->built_for || !same_scene(*parts_->built_for, conditions))
        parts_->build(conditions);
    parts_->show(conditions.road_users);
    parts_->sky->setLocation(map_from_camera.x(), map_from_camera.y(), map_from_camera.z());
    auto view = parts_->renderer->draw(camera, map_from_camera);
    view.image.convertTo(view.image, -1, conditions.exposure);
    view.depth.setTo(0, view.depth > 0.6 * kSkyRadius);
    return view;
}

}  // namespace fild
