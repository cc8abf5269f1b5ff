// SPDX-License-Identifier: BSD-3-Clause
#include "street_furniture.h"

#include "textured_mesh.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace fild
{
namespace
{
/** Turns metres ahead, to the left and up from a place into points of the town. */
class PlaceFrame
{
 public:
    PlaceFrame(const StandingObject& place, double base) : place_(place), base_(base) {}

    cv::Point3d at(double ahead, double left, double up) const
    {
        const auto c = std::cos(place_.heading);
        const auto s = std::sin(place_.heading);
        return {place_.at.x + c * ahead - s * left, place_.at.y + s * ahead + c * left, base_ + up};
    }

 private:
    const StandingObject& place_;
    double base_;
};

cv::Mat paint_noise(const cv::Size& size, const Colour& colour, double strength, Lot& lot)
{
    cv::Mat picture(size, CV_8UC3, scalar(colour));
    shade(picture, fractal_noise(size, 32, lot), strength);
    add_grain(picture, 8, lot);
    return picture;
}

/** Leaves; darker towards the lower edge, where a crown is in its own shade. */
cv::Mat paint_leaves()
{
    constexpr int kSide = 512;
    constexpr int kLeaves = 9000;
    Lot lot(61);
    cv::Mat leaves(kSide, kSide, CV_8UC3, cv::Scalar(18, 38, 26));
    for (int i = 0; i < kLeaves; ++i)
    {
        const cv::Point at(lot.whole(0, kSide - 1), lot.whole(0, kSide - 1));
        const auto light = (1.3 - 0.9 * at.y / kSide) * lot.real(0.7, 1.3);
        const Colour green(lot.real(25, 60), lot.real(85, 135), lot.real(50, 105));
        cv::ellipse(leaves,
                    at,
                    cv::Size(lot.whole(4, 9), lot.whole(2, 4)),
                    lot.real(0, 180),
                    0,
                    360,
                    scalar(brighter(green, light)),
                    cv::FILLED,
                    cv::LINE_AA);
    }
    return leaves;
}

/** An upright prism of `sides` sides around a point. */
void add_post(TexturedMesh& mesh,
              const PlaceFrame& frame,
              const cv::Point2d& centre,
              const cv::Vec2d& bottom_and_top,
              double radius,
              int sides)
{
    const auto height = bottom_and_top[1] - bottom_and_top[0];
    for (int i = 0; i < sides; ++i)
    {
        const auto a = 2 * CV_PI * i / sides;
        const auto b = 2 * CV_PI * (i + 1) / sides;
        const auto corner = [&](double angle, double up) {
            return frame.at(
                centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), up);
        };
        mesh.add_panel({corner(a, bottom_and_top[0]),
                        corner(b, bottom_and_top[0]),
                        corner(b, bottom_and_top[1]),
                        corner(a, bottom_and_top[1])},
                       {static_cast<double>(i) / sides, 0, 1.0 / sides, height / 3});
    }
}

/** A lumpy ball of leaves. */
void add_crown(TexturedMesh& mesh, const cv::Point3d& centre, double radius, Lot& lot)
{
    constexpr int kAround = 10;
    constexpr int kUp = 7;
    std::array<std::array<double, kAround + 1>, kUp + 1> lumps{};
    for (auto& ring : lumps)
    {
        for (auto& lump : ring) lump = radius * lot.real(0.78, 1.12);
        ring.back() = ring.front();
    }
    lumps.front().fill(radius);
    lumps.back().fill(radius);
    const auto turn = lot.real(0, 1);
    const auto direction = [](int around, int up)
    {
        const auto azimuth = 2 * CV_PI * around / kAround;
        const auto polar = CV_PI * up / kUp;
        return cv::Point3d(std::sin(polar) * std::cos(azimuth),
                           std::sin(polar) * std::sin(azimuth),
                           -std::cos(polar));
    };
    const auto corner = [&](int around, int up)
    {
        const auto lump = lumps[static_cast<std::size_t>(up)][static_cast<std::size_t>(around)];
        return Corner{centre + lump * direction(around, up),
                      {turn + 1.5 * radius * around / kAround, 0.98 - 0.96 * up / kUp}};
    };
    for (int up = 0; up < kUp; ++up)
        for (int around = 0; around < kAround; ++around)
        {
            const int next = around + 1;
            mesh.add_smooth_triangle(
                {corner(around, up), corner(next, up), corner(next, up + 1)},
                {direction(around, up), direction(next, up), direction(next, up + 1)});
            mesh.add_smooth_triangle(
                {corner(around, up), corner(next, up + 1), corner(around, up + 1)},
                {direction(around, up), direction(next, up + 1), direction(around, up + 1)});
        }
}

constexpr double kCarLength = 4.3;
constexpr double kCarWidth = 1.72;
constexpr double kCarHeight = 1.95;  // of the tallest
constexpr double kWheelRadius = 0.32;
constexpr std::array<double, 2> kAxles{0.8, 3.4};
constexpr int kCarModels = 32;
constexpr int kCarScale = 60;  // pixels per metre
constexpr int kSidePixels = static_cast<int>(kCarHeight * kCarScale) + 1;
constexpr int kTopPixels = static_cast<int>(kCarWidth * kCarScale) + 1;
constexpr int kPaintPixels = kSidePixels + kTopPixels;

/** Outline of a car from the side, from the lower rear corner over the roof to the lower front
 *  one: metres from the rear, metres over the road. */
using CarOutline = std::array<cv::Point2d, 10>;
constexpr std::size_t kCarParts = 9;  // bumper, boot lid, boot, rear window, roof, ...

const std::array<CarOutline, 4>& car_outlines()
{
    static const std::array<CarOutline, 4> outlines{CarOutline{{{0.05, 0.25},
                                                                {0, 0.55},
                                                                {0.05, 0.9},
                                                                {0.5, 1.0},
                                                                {1.1, 1.45},
                                                                {2.4, 1.48},
                                                                {3.2, 0.98},
                                                                {4.1, 0.82},
                                                                {4.3, 0.6},
                                                                {4.25, 0.25}}},  // saloon
                                                    CarOutline{{{0.1, 0.25},
                                                                {0.05, 0.6},
                                                                {0.1, 0.95},
                                                                {0.15, 1.05},
                                                                {0.7, 1.5},
                                                                {2.3, 1.52},
                                                                {3.2, 1.0},
                                                                {4.0, 0.88},
                                                                {4.2, 0.6},
                                                                {4.15, 0.25}}},  // hatchback
                                                    CarOutline{{{0.05, 0.25},
                                                                {0, 0.55},
                                                                {0.02, 0.9},
                                                                {0.05, 1.02},
                                                                {0.3, 1.5},
                                                                {2.5, 1.5},
                                                                {3.3, 1.0},
                                                                {4.15, 0.85},
                                                                {4.3, 0.6},
                                                                {4.25, 0.25}}},  // estate
                                                    CarOutline{{{0.03, 0.28},
                                                                {0, 0.6},
                                                                {0, 1.0},
                                                                {0.02, 1.15},
                                                                {0.1, 1.9},
                                                                {2.9, 1.92},
                                                                {3.6, 1.15},
                                                                {4.15, 0.98},
                                                                {4.3, 0.65},
                                                                {4.25, 0.28}}}};  // van
    return outlines;
}

/** One of the kinds of car that stand in the town: 32, so that equal ones are rare. */
struct CarModel
{
    CarOutline outline;
    Colour colour;
    std::uint64_t looks = 0;
};

CarModel car_model(int index)
{
    static const std::vector<Colour> colours{{180, 60, 40},
                                             {45, 40, 160},
                                             {200, 200, 205},
                                             {60, 60, 62},
                                             {225, 228, 230},
                                             {70, 100, 60},
                                             {50, 140, 190},
                                             {120, 115, 110},
                                             {130, 90, 60},
                                             {60, 60, 90}};
    Lot lot(static_cast<std::uint64_t>(700 + index));
    CarModel model;
    model.outline = car_outlines()[static_cast<std::size_t>(lot.whole(0, 3))];
    const auto taller = lot.real(0.92, 1.0);
    for (auto& point : model.outline)
    {
        point.y *= point.y > 0.8 ? taller : 1;
        point.x += point.y > 0.8 ? lot.real(-0.08, 0.08) : 0;
    }
    model.colour = brighter(lot.pick(colours), lot.real(0.8, 1.15));
    model.looks = lot.seed();
    return model;
}

/** Paints the side of a car, its front to the right. */
class CarSidePainter
{
 public:
    CarSidePainter(const cv::Mat& side, const CarModel& model)
        : side_(side), model_(model), lot_(model.looks)
    {
    }
    void paint()
    {
        side_ = scalar(model_.colour);
        windows();
        doors();
        lower_parts();
    }

 private:
    static cv::Point pixel(const cv::Point2d& metres)
    {
        return {cvRound(metres.x * kCarScale), cvRound((kCarHeight - metres.y) * kCarScale)};
    }
    void bar(const cv::Point2d& a, const cv::Point2d& b, const Colour& colour)
    {
        cv::rectangle(side_, pixel(a), pixel(b), scalar(colour), cv::FILLED);
    }
    void windows();
    void doors();
    void lower_parts();

    cv::Mat side_;
    const CarModel& model_;
    Lot lot_;
};

void CarSidePainter::windows()
{
    const auto& outline = model_.outline;
    const auto sill = std::max(outline[3].y, outline[6].y);
    const std::vector<cv::Point> glass{pixel({outline[3].x + 0.3, sill}),
                                       pixel(outline[4] + cv::Point2d(0.15, -0.08)),
                                       pixel(outline[5] + cv::Point2d(-0.08, -0.08)),
                                       pixel({outline[6].x - 0.25, sill})};
    const auto tone = lot_.real(50, 110);
    cv::fillConvexPoly(side_, glass, {tone, tone * 0.88, tone * 0.8}, cv::LINE_AA);
    cv::polylines(side_, glass, true, {30, 30, 30}, lot_.whole(1, 3), cv::LINE_AA);
    const auto pillars = lot_.whole(1, 3);
    for (int i = 1; i <= pillars; ++i)
    {
        const auto x = outline[4].x + (outline[5].x - outline[4].x) * i / (pillars + 1.0) +
                       lot_.real(-0.15, 0.15);
        bar({x, outline[4].y}, {x + lot_.real(0.05, 0.14), sill}, model_.colour);
    }
}

void CarSidePainter::doors()
{
    const auto line = scalar(brighter(model_.colour, lot_.real(0.4, 0.7)));
    const auto count = lot_.whole(2, 4);
    for (int i = 0; i < count; ++i)
    {
        const auto x = 1 + 2.2 * (i + lot_.real(0.1, 0.9)) / count;
        cv::line(side_, pixel({x, 1.0}), pixel({x + lot_.real(-0.1, 0.1), 0.35}), line, 1);
        bar({x + 0.12, 0.88}, {x + lot_.real(0.2, 0.4), 0.83}, brighter(model_.colour, 0.35));
    }
    const auto trim = lot_.real(0.45, 0.7);
    if (lot_.chance(0.6))
        bar({0.1, trim},
            {4.2, trim - lot_.real(0.02, 0.1)},
            brighter(model_.colour, lot_.real(0.3, 1.4)));
    if (lot_.chance(0.4))
        cv::putText(
            side_,
            lot_.pick<std::string>({"TAXI", "RADIO 7", "EXPRESS", "POST", "AQUA", "FIX IT"}),
            pixel({lot_.real(0.9, 1.8), 0.62}),
            cv::FONT_HERSHEY_DUPLEX,
            lot_.real(0.5, 0.9),
            scalar(brighter(model_.colour, lot_.chance(0.5) ? 0.3 : 2.2)),
            1,
            cv::LINE_AA);
}

void CarSidePainter::lower_parts()
{
    bar({0, lot_.real(0.3, 0.42)}, {4.3, 0}, {35, 35, 38});
    for (const double axle : kAxles)
        cv::circle(side_,
                   pixel({axle, kWheelRadius}),
                   cvRound(lot_.real(0.36, 0.43) * kCarScale),
                   {20, 20, 20},
                   cv::FILLED,
                   cv::LINE_AA);
    bar({0, 0.85}, {lot_.real(0.1, 0.25), lot_.real(0.55, 0.75)}, {40, 35, 150});
    bar({4.3, 0.75}, {lot_.real(4.0, 4.15), lot_.real(0.6, 0.68)}, {215, 225, 228});
}

/** Paints what is seen of a car from behind, above and in front: a part of the strip for each part
 *  of the outline. */
class CarTopPainter
{
 public:
    CarTopPainter(const cv::Mat& top, const CarModel& model)
        : top_(top), colour_(model.colour), lot_(model.looks + 1)
    {
    }
    void paint();

 private:
    /** A piece of one part of the outline. \param along, across  shares of it. */
    void piece(std::size_t part,
               const cv::Vec2d& along,
               const cv::Vec2d& across,
               const Colour& tone)
    {
        const auto step = static_cast<double>(top_.cols) / kCarParts;
        const auto first = static_cast<double>(part);
        cv::rectangle(
            top_,
            cv::Rect(cv::Point(cvRound((first + along[0]) * step), cvRound(across[0] * top_.rows)),
                     cv::Point(cvRound((first + along[1]) * step), cvRound(across[1] * top_.rows))),
            scalar(tone),
            cv::FILLED);
    }
    /** Something on both sides of the middle. */
    void pair(
        std::size_t part, const cv::Vec2d& along, double outer, double width, const Colour& tone)
    {
        piece(part, along, {outer, outer + width}, tone);
        piece(part, along, {1 - outer - width, 1 - outer}, tone);
    }

    cv::Mat top_;
    Colour colour_;
    Lot lot_;
};

void CarTopPainter::paint()
{
    top_ = scalar(colour_);
    const Colour bumper = lot_.chance(0.5) ? Colour(45, 45, 48) : brighter(colour_, 0.8);
    piece(0, {0, 1}, {0, 1}, bumper);
    piece(8, {0, 1}, {0, 1}, bumper);
    const auto plate = lot_.real(0.3, 0.4);
    piece(lot_.chance(0.5) ? 0U : 1U, {0.3, 0.65}, {plate, 1 - plate}, {210, 225, 225});
    piece(8, {0.2, 0.6}, {plate, 1 - plate}, {210, 225, 225});
    const auto lamp = lot_.real(0.08, 0.2);
    const auto inset = lot_.real(0.02, 0.08);
    const auto low = lot_.real(0.1, 0.45);
    pair(1, {low, low + lot_.real(0.25, 0.5)}, inset, lamp, {40, 35, lot_.real(120, 190)});
    pair(7, {low, 0.95}, inset, lamp * 1.2, {215, 225, 228});
    const auto glass = brighter({95, 80, 70}, lot_.real(0.7, 1.3));
    const auto margin = lot_.real(0.06, 0.14);
    piece(3, {0.1, 0.9}, {margin, 1 - margin}, glass);
    piece(5, {0.08, 0.92}, {margin, 1 - margin}, brighter(glass, 1.1));
    piece(6, {0.95, 1}, {0, 1}, brighter(colour_, 0.5));
    piece(7, {0.2, lot_.real(0.6, 0.9)}, {0.3, 0.7}, {50, 50, 52});
    if (lot_.chance(0.4)) pair(4, {0.1, 0.9}, 0.12, 0.04, {50, 50, 52});  // roof rack
}

/** Side and top of every car, below each other. */
cv::Mat paint_cars()
{
    const auto width = static_cast<int>(kCarLength * kCarScale);
    cv::Mat picture(kCarModels * kPaintPixels, width, CV_8UC3);
    for (int i = 0; i < kCarModels; ++i)
    {
        const auto model = car_model(i);
        const auto top = i * kPaintPixels;
        CarSidePainter(picture.rowRange(top, top + kSidePixels), model).paint();
        CarTopPainter(picture.rowRange(top + kSidePixels, top + kPaintPixels), model).paint();
    }
    Lot lot(71);
    add_stains(picture, 20 * kCarModels, 12, lot);
    shade(picture, fractal_noise(picture.size(), 40, lot), 0.07);
    add_grain(picture, 3, lot);
    return picture;
}

void add_car_body(TexturedMesh& mesh, const PlaceFrame& frame, int index)
{
    const auto outline = car_model(index).outline;
    constexpr double kAll = 1.0 * kCarModels * kPaintPixels;
    const auto side_top = index * kPaintPixels / kAll;
    const auto strip_top = side_top + kSidePixels / kAll;
    const auto strip_height = kTopPixels / kAll;
    const auto corner = [&](const cv::Point2d& point, double left)
    {
        const cv::Point2d in_picture(point.x / kCarLength,
                                     side_top + (1 - point.y / kCarHeight) * kSidePixels / kAll);
        return Corner{frame.at(point.x - kCarLength / 2, left, point.y), in_picture};
    };
    const cv::Point2d middle(2, 0.6);
    const auto half = kCarWidth / 2;
    for (std::size_t i = 0; i <= kCarParts; ++i)
    {
        const auto& a = outline[i];
        const auto& b = outline[(i + 1) % outline.size()];
        mesh.add_triangle(corner(middle, half), corner(a, half), corner(b, half));
        mesh.add_triangle(corner(middle, -half), corner(b, -half), corner(a, -half));
        if (i == kCarParts) break;
        const auto left = static_cast<double>(i) / kCarParts;
        const auto right = static_cast<double>(i + 1) / kCarParts;
        mesh.add_quad({corner(a, -half).at, {left, strip_top + strip_height}},
                      {corner(b, -half).at, {right, strip_top + strip_height}},
                      {corner(b, half).at, {right, strip_top}},
                      {corner(a, half).at, {left, strip_top}});
    }
}

constexpr int kWheelKinds = 16;
constexpr int kWheelPixels = 64;

void paint_wheel(cv::Mat&& wheel, Lot& lot)
{
    const cv::Point middle(kWheelPixels / 2, kWheelPixels / 2);
    wheel = cv::Scalar(28, 28, 30);
    const auto light = lot.real(90, 190);
    const auto rim = lot.whole(16, 23);
    cv::circle(wheel, middle, rim, cv::Scalar::all(light), cv::FILLED, cv::LINE_AA);
    const auto spokes = lot.whole(3, 9);
    const auto turn = lot.real(0, 2 * CV_PI);
    for (int spoke = 0; spoke < spokes; ++spoke)
    {
        const auto angle = turn + 2 * CV_PI * spoke / spokes;
        const cv::Point out(cvRound(rim * std::cos(angle)), cvRound(rim * std::sin(angle)));
        cv::line(wheel,
                 middle,
                 middle + out,
                 cv::Scalar::all(light * 0.3),
                 lot.whole(2, 5),
                 cv::LINE_AA);
    }
    cv::circle(wheel, middle, lot.whole(3, 8), cv::Scalar::all(light * 0.8), cv::FILLED);
}

cv::Mat paint_wheels()
{
    Lot lot(72);
    cv::Mat picture(kWheelKinds * kWheelPixels, kWheelPixels, CV_8UC3);
    for (int kind = 0; kind < kWheelKinds; ++kind)
        paint_wheel(picture.rowRange(kind * kWheelPixels, (kind + 1) * kWheelPixels), lot);
    add_grain(picture, 8, lot);
    return picture;
}

/** One wheel; `turned` by some angle, rad. */
void add_wheel(
    TexturedMesh& mesh, const PlaceFrame& frame, const cv::Point2d& axle, int kind, double turned)
{
    constexpr int kSides = 14;
    const auto side = axle.y > 0 ? 1.0 : -1.0;
    const auto in_picture = [&](double angle, double radius)
    {
        return cv::Point2d(0.5 + 0.5 * radius * std::cos(angle + turned),
                           (kind + 0.5 + 0.49 * radius * std::sin(angle + turned)) / kWheelKinds);
    };
    const auto rim = [&](int index)
    {
        const auto angle = side * 2 * CV_PI * index / kSides;
        return Corner{frame.at(axle.x + kWheelRadius * std::cos(angle),
                               axle.y,
                               kWheelRadius * (1 - std::sin(angle))),
                      in_picture(angle, 1)};
    };
    const Corner hub{frame.at(axle.x, axle.y, kWheelRadius), in_picture(0, 0)};
    for (int i = 0; i < kSides; ++i) mesh.add_triangle(hub, rim(i), rim(i + 1));
}

void add_wheels(TexturedMesh& mesh, const PlaceFrame& frame, Lot& lot)
{
    const auto kind = lot.whole(0, kWheelKinds - 1);
    for (const double axle : kAxles)
        for (const double side : {-1.0, 1.0})
            add_wheel(mesh,
                      frame,
                      {axle - kCarLength / 2, side * (kCarWidth / 2 + 0.02)},
                      kind,
                      lot.real(0, 2 * CV_PI));
}
}  // namespace

void add_trees(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& trees)
{
    TexturedMesh trunks;
    TexturedMesh crowns;
    for (const auto& tree : trees)
    {
        Lot lot(tree.seed);
        const PlaceFrame frame(tree, kKerbHeight);
        const auto height = lot.real(2.4, 3.2);
        add_post(trunks, frame, {0, 0}, {0, height + 0.5}, lot.real(0.1, 0.2), 8);
        const auto clumps = lot.whole(4, 7);
        for (int i = 0; i < clumps; ++i)
            add_crown(
                crowns,
                frame.at(lot.real(-0.8, 0.8), lot.real(-0.7, 0.7), height + lot.real(0.2, 1.9)),
                lot.real(0.6, 1.15),
                lot);
    }
    Lot lot(62);
    scene.insert(trunks.object(paint_noise({128, 256}, {55, 75, 95}, 0.25, lot)));
    scene.insert(crowns.object(paint_leaves()));
}

void add_lamp_posts(mrpt::opengl::COpenGLScene& scene,
                    const std::vector<StandingObject>& lamp_posts)
{
    TexturedMesh posts;
    for (const auto& place : lamp_posts)
    {
        const PlaceFrame frame(place, kKerbHeight);
        add_post(posts, frame, {0, 0}, {0, 0.9}, 0.12, 8);
        add_post(posts, frame, {0, 0}, {0.9, 4.6}, 0.06, 8);
        add_post(posts, frame, {0, 0}, {4.6, 5.1}, 0.2, 6);
        add_post(posts, frame, {0, 0}, {5.1, 5.2}, 0.28, 6);
    }
    Lot lot(63);
    scene.insert(posts.object(paint_noise({64, 256}, {62, 66, 60}, 0.15, lot)));
}

void add_cars(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& cars)
{
    TexturedMesh bodies;
    TexturedMesh wheels;
    for (const auto& car : cars)
    {
        Lot lot(car.seed);
        const PlaceFrame frame(car, 0);
        add_car_body(bodies, frame, lot.whole(0, kCarModels - 1));
        add_wheels(wheels, frame, lot);
    }
    scene.insert(bodies.object(paint_cars()));
    scene.insert(wheels.object(paint_wheels()));
}

}  // namespace fild
