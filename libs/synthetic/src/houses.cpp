// SPDX-License-Identifier: BSD-3-Clause
#include "houses.h"

#include "textured_mesh.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>

namespace fild
{
namespace
{
constexpr int kRoofKinds = 3;
constexpr double kTileSide = 4;  ///< m, of the pictures that repeat on walls and roofs
constexpr double kRidge = 2.6;  ///< m over the eaves

/** Pictures shared by all houses. */
struct SharedMeshes
{
    TexturedMesh plain_walls;
    std::array<TexturedMesh, kRoofKinds> roofs;
};

cv::Mat paint_plain_wall()
{
    Lot lot(41);
    cv::Mat wall(pixels(kTileSide), pixels(kTileSide), CV_8UC3);
    lay_bricks(wall, cv::Rect({0, 0}, wall.size()), {10, 4}, {125, 145, 165}, {95, 105, 115}, lot);
    shade(wall, fractal_noise(wall.size(), pixels(2), lot), 0.1);
    add_grain(wall, 5, lot);
    return wall;
}

cv::Mat paint_roof(int kind)
{
    const std::array<Colour, kRoofKinds> colours{
        Colour(60, 75, 150), Colour(85, 80, 78), Colour(70, 95, 120)};
    Lot lot(static_cast<std::uint64_t>(50 + kind));
    cv::Mat roof(pixels(kTileSide), pixels(kTileSide), CV_8UC3);
    const auto& colour = colours.at(static_cast<std::size_t>(kind));
    lay_bricks(roof, cv::Rect({0, 0}, roof.size()), {10, 12}, colour, brighter(colour, 0.55), lot);
    shade(roof, fractal_noise(roof.size(), pixels(2), lot), 0.12);
    add_grain(roof, 5, lot);
    return roof;
}

/** One house: turns metres to the right, out of the front and up into points of the town. */
class HouseFrame
{
 public:
    HouseFrame(const HouseRow& row, const House& house) : row_(row), offset_(house.offset) {}

    cv::Point3d at(double right, double out, double up) const
    {
        const auto ground = row_.at(offset_ + right, out);
        return {ground.x, ground.y, kKerbHeight + up};
    }
    /** An upright panel that faces the street. */
    std::array<cv::Point3d, 4> front(const cv::Rect2d& right_and_up, double out) const
    {
        const auto x = right_and_up.x;
        const auto y = right_and_up.y;
        const auto end = x + right_and_up.width;
        const auto top = y + right_and_up.height;
        return {at(x, out, y), at(end, out, y), at(end, out, top), at(x, out, top)};
    }

 private:
    const HouseRow& row_;
    double offset_;
};

/** The part of a front's picture from `down` to `down + height` metres below its top. */
cv::Rect2d picture_part(const cv::Rect& front, const cv::Rect2d& metres, const cv::Size& picture)
{
    const cv::Point2d scale(1.0 / picture.width, 1.0 / picture.height);
    return {(front.x + metres.x * kPixelsPerMetre) * scale.x,
            (front.y + metres.y * kPixelsPerMetre) * scale.y,
            metres.width * kPixelsPerMetre * scale.x,
            metres.height * kPixelsPerMetre * scale.y};
}

void add_plain_panel(TexturedMesh& mesh, const std::array<cv::Point3d, 4>& corners)
{
    const auto width = cv::norm(corners[1] - corners[0]);
    const auto height = cv::norm(corners[3] - corners[0]);
    mesh.add_panel(corners, {0, 0, width / kTileSide, height / kTileSide});
}

/** A balcony that stands out of the front and shows its own part of the picture. */
void add_balcony(TexturedMesh& fronts,
                 SharedMeshes& shared,
                 const HouseFrame& frame,
                 const FacadeDesign& design,
                 const cv::Rect& front,
                 const cv::Size& picture)
{
    constexpr double kOut = 0.9;
    constexpr double kHeight = 1.15;
    const auto bottom = design.balcony_floor * design.floor_height - 0.05;
    const cv::Rect2d place(0.6, bottom, design.width - 1.2, kHeight);
    const auto down = design.height() - bottom - kHeight;
    fronts.add_panel(frame.front(place, kOut),
                     picture_part(front, {place.x, down, place.width, kHeight}, picture));
    const auto end = place.x + place.width;
    add_plain_panel(shared.plain_walls,
                    {frame.at(place.x, 0, bottom),
                     frame.at(place.x, kOut, bottom),
                     frame.at(place.x, kOut, bottom + kHeight),
                     frame.at(place.x, 0, bottom + kHeight)});
    add_plain_panel(shared.plain_walls,
                    {frame.at(end, kOut, bottom),
                     frame.at(end, 0, bottom),
                     frame.at(end, 0, bottom + kHeight),
                     frame.at(end, kOut, bottom + kHeight)});
    add_plain_panel(shared.plain_walls,
                    {frame.at(place.x, 0, bottom),
                     frame.at(end, 0, bottom),
                     frame.at(end, kOut, bottom),
                     frame.at(place.x, kOut, bottom)});
}

/** The painted awning of a shop, spread over the pavement. */
void add_awning(TexturedMesh& fronts,
                const HouseFrame& frame,
                const FacadeDesign& design,
                const cv::Rect& front,
                const cv::Size& picture)
{
    constexpr double kDrop = 0.75;
    constexpr double kOut = 1.1;
    const auto top = design.floor_height - 0.8;
    const auto end = design.width - 0.3;
    const auto down = design.height() - top;
    fronts.add_panel({frame.at(0.3, kOut, top - kDrop),
                      frame.at(end, kOut, top - kDrop),
                      frame.at(end, 0.02, top),
                      frame.at(0.3, 0.02, top)},
                     picture_part(front, {0.3, down, end - 0.3, kDrop}, picture));
}

void add_walls(SharedMeshes& shared, const HouseFrame& frame, const FacadeDesign& design)
{
    const auto width = design.width;
    const auto height = design.height();
    auto& walls = shared.plain_walls;
    const auto back = -kHouseDepth;
    add_plain_panel(walls,
                    {frame.at(width, back, 0),
                     frame.at(0, back, 0),
                     frame.at(0, back, height),
                     frame.at(width, back, height)});
    add_plain_panel(walls,
                    {frame.at(0, back, 0),
                     frame.at(0, 0, 0),
                     frame.at(0, 0, height),
                     frame.at(0, back, height)});
    add_plain_panel(walls,
                    {frame.at(width, 0, 0),
                     frame.at(width, back, 0),
                     frame.at(width, back, height),
                     frame.at(width, 0, height)});
}

void add_roof(SharedMeshes& shared, const HouseFrame& frame, const FacadeDesign& design)
{
    const auto width = design.width;
    const auto eaves = design.height();
    const auto ridge = eaves + kRidge;
    const auto middle = -kHouseDepth / 2;
    const auto back = -kHouseDepth;
    auto& roof = shared.roofs.at(static_cast<std::size_t>(design.roof));
    add_plain_panel(roof,
                    {frame.at(0, 0, eaves),
                     frame.at(width, 0, eaves),
                     frame.at(width, middle, ridge),
                     frame.at(0, middle, ridge)});
    add_plain_panel(roof,
                    {frame.at(width, back, eaves),
                     frame.at(0, back, eaves),
                     frame.at(0, middle, ridge),
                     frame.at(width, middle, ridge)});
    const auto slope = kHouseDepth / kTileSide;
    for (const double right : {0.0, width})
    {
        const auto first = right == 0 ? back : 0;
        const auto last = right == 0 ? 0 : back;
        shared.plain_walls.add_triangle({frame.at(right, first, eaves), {0, slope / 4}},
                                        {frame.at(right, last, eaves), {slope, slope / 4}},
                                        {frame.at(right, middle, ridge), {slope / 2, 0}});
    }
}

void add_chimney(SharedMeshes& shared, const HouseFrame& frame, const FacadeDesign& design)
{
    constexpr double kSide = 0.8;
    const auto right = design.width * 0.7;
    const auto bottom = design.height() + 1;
    const auto top = bottom + 2.4;
    const std::array<cv::Point2d, 4> corners{cv::Point2d(right, -2.5),
                                             cv::Point2d(right + kSide, -2.5),
                                             cv::Point2d(right + kSide, -2.5 - kSide),
                                             cv::Point2d(right, -2.5 - kSide)};
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const auto& a = corners[i];
        const auto& b = corners[(i + 1) % corners.size()];
        add_plain_panel(shared.plain_walls,
                        {frame.at(a.x, a.y, bottom),
                         frame.at(b.x, b.y, bottom),
                         frame.at(b.x, b.y, top),
                         frame.at(a.x, a.y, top)});
    }
}

/** The end wall of a row that stands on another street: windows instead of plain bricks. */
void add_end_wall(TexturedMesh& fronts,
                  const HouseFrame& frame,
                  const FacadeDesign& design,
                  bool left,
                  const cv::Rect& painted,
                  const cv::Size& picture)
{
    constexpr double kBefore = 0.02;  // the plain wall stands behind
    const auto right = left ? -kBefore : design.width + kBefore;
    const auto from = left ? -kHouseDepth : 0;
    const auto to = left ? 0 : -kHouseDepth;
    fronts.add_panel({frame.at(right, from, 0),
                      frame.at(right, to, 0),
                      frame.at(right, to, design.height()),
                      frame.at(right, from, design.height())},
                     picture_part(painted, {0, 0, kHouseDepth, design.height()}, picture));
}

void add_row(TexturedMesh& fronts,
             SharedMeshes& shared,
             const HouseRow& row,
             const RowPicture& picture)
{
    const auto size = picture.picture.size();
    for (std::size_t i = 0; i < row.houses.size(); ++i)
    {
        const auto& design = row.houses[i].design;
        const HouseFrame frame(row, row.houses[i]);
        const auto& front = picture.fronts[i];
        fronts.add_panel(frame.front({0, 0, design.width, design.height()}, 0),
                         picture_part(front, {0, 0, design.width, design.height()}, size));
        if (design.balcony_floor > 0) add_balcony(fronts, shared, frame, design, front, size);
        if (design.shop && design.awning) add_awning(fronts, frame, design, front, size);
        add_walls(shared, frame, design);
        add_roof(shared, frame, design);
        add_chimney(shared, frame, design);
        if (picture.end_walls.empty()) continue;
        if (i == 0) add_end_wall(fronts, frame, design, true, picture.end_walls[0], size);
        if (i + 1 == row.houses.size())
            add_end_wall(fronts, frame, design, false, picture.end_walls[1], size);
    }
}
}  // namespace

RowPicture paint_row(const HouseRow& row)
{
    std::vector<cv::Mat> walls;
    for (const auto& house : row.houses)
        walls.push_back(paint_facade(house.design, house.design.width, house.wear));
    if (row.ends_in_corners)
        for (const auto* house : {&row.houses.front(), &row.houses.back()})
        {
            auto design = house->design;
            design.shop = false;
            design.balcony_floor = 0;
            walls.push_back(paint_facade(design, kHouseDepth, house->wear + 1));
        }
    cv::Size size(0, 0);
    for (const auto& wall : walls)
        size = {size.width + wall.cols, std::max(size.height, wall.rows)};
    RowPicture painted;
    painted.picture = cv::Mat::zeros(size, CV_8UC3);
    int left = 0;
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        const cv::Rect place({left, size.height - walls[i].rows}, walls[i].size());
        walls[i].copyTo(painted.picture(place));
        (i < row.houses.size() ? painted.fronts : painted.end_walls).push_back(place);
        left += place.width;
    }
    return painted;
}

void add_houses(mrpt::opengl::COpenGLScene& scene,
                const TownPlan& plan,
                const std::vector<RowPicture>& pictures)
{
    SharedMeshes shared;
    for (std::size_t i = 0; i < plan.rows.size(); ++i)
    {
        TexturedMesh fronts;
        add_row(fronts, shared, plan.rows[i], pictures[i]);
        scene.insert(fronts.object(pictures[i].picture));
    }
    scene.insert(shared.plain_walls.object(paint_plain_wall()));
    for (int kind = 0; kind < kRoofKinds; ++kind)
        scene.insert(shared.roofs.at(static_cast<std::size_t>(kind)).object(paint_roof(kind)));
}

}  // namespace fild
