// SPDX-License-Identifier: BSD-3-Clause
#include "street_furniture.h"

#include "textured_mesh.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>

namespace fild
{
namespace
{
/** Turns metres ahead, to the left and up from a place into points of the town. */
class PlaceFrame
{
 public:
    PlaceFrame(const Place& place, double base) : place_(place), base_(base) {}

    cv::Point3d at(double ahead, double left, double up) const
    {
        const auto c = std::cos(place_.heading);
        const auto s = std::sin(place_.heading);
        return {place_.at.x + c * ahead - s * left, place_.at.y + s * ahead + c * left, base_ + up};
    }

 private:
    const Place& place_;
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
constexpr double kCarHeight = 1.48;
constexpr double kWheelRadius = 0.32;
constexpr std::array<double, 2> kAxles{0.8, 3.4};

/** Outline of a car from the side, from the lower rear corner over the roof to the lower front
 *  one: metres from the rear, metres over the road. */
const std::array<cv::Point2d, 10> kOutline{cv::Point2d(0.05, 0.25),
                                           cv::Point2d(0, 0.55),
                                           cv::Point2d(0.05, 0.9),
                                           cv::Point2d(0.5, 1.0),
                                           cv::Point2d(1.1, 1.45),
                                           cv::Point2d(2.4, 1.48),
                                           cv::Point2d(3.2, 0.98),
                                           cv::Point2d(4.1, 0.82),
                                           cv::Point2d(4.3, 0.6),
                                           cv::Point2d(4.25, 0.25)};
constexpr int kCarScale = 60;  // pixels per metre
constexpr int kSidePixels = static_cast<int>(kCarHeight * kCarScale) + 1;
constexpr int kTopPixels = static_cast<int>(kCarWidth * kCarScale) + 1;
constexpr int kPaintPixels = kSidePixels + kTopPixels;

const std::vector<Colour>& car_colours()
{
    static const std::vector<Colour> colours{{180, 60, 40},
                                             {45, 40, 160},
                                             {200, 200, 205},
                                             {60, 60, 62},
                                             {225, 228, 230},
                                             {70, 100, 60},
                                             {50, 140, 190},
                                             {120, 115, 110}};
    return colours;
}

cv::Point car_pixel(const cv::Point2d& metres)
{
    return {cvRound(metres.x * kCarScale), cvRound((kCarHeight - metres.y) * kCarScale)};
}

void paint_car_side(cv::Mat side, const Colour& colour)
{
    side = scalar(colour);
    const std::vector<cv::Point> glass{car_pixel({0.75, 1.0}),
                                       car_pixel({1.2, 1.38}),
                                       car_pixel({2.35, 1.4}),
                                       car_pixel({3.0, 0.98})};
    cv::fillConvexPoly(side, glass, {95, 80, 70}, cv::LINE_AA);
    cv::polylines(side, glass, true, {30, 30, 30}, 2, cv::LINE_AA);
    const auto line = scalar(brighter(colour, 0.5));
    for (const double x : {1.15, 2.0, 3.0})
        cv::line(side, car_pixel({x, 1.0}), car_pixel({x, 0.35}), line, 1, cv::LINE_AA);
    cv::line(side, car_pixel({1.85, 1.4}), car_pixel({1.85, 1.0}), scalar(colour), 4);
    for (const double x : {1.3, 2.15})
        cv::rectangle(side,
                      car_pixel({x, 0.9}),
                      car_pixel({x + 0.2, 0.86}),
                      scalar(brighter(colour, 0.35)),
                      cv::FILLED);
    cv::line(side, car_pixel({0.1, 0.55}), car_pixel({4.2, 0.55}), line, 2);
    cv::rectangle(side, car_pixel({0, 0.36}), car_pixel({4.3, 0.2}), {35, 35, 38}, cv::FILLED);
    for (const double axle : kAxles)
        cv::circle(side,
                   car_pixel({axle, kWheelRadius}),
                   cvRound(0.4 * kCarScale),
                   {20, 20, 20},
                   cv::FILLED,
                   cv::LINE_AA);
}

/** What is seen of each part of the outline from behind, above and in front: glass, lamps. */
void paint_car_top(cv::Mat top, const Colour& colour)
{
    top = scalar(colour);
    const auto step = static_cast<double>(top.cols) / (kOutline.size() - 1);
    const auto part = [&](int index, const cv::Vec2d& along, const cv::Vec2d& across)
    {
        return cv::Rect(
            cv::Point(cvRound((index + along[0]) * step), cvRound(across[0] * top.rows)),
            cv::Point(cvRound((index + along[1]) * step), cvRound(across[1] * top.rows)));
    };
    const auto paint = [&](const cv::Rect& place, const cv::Scalar& tone)
    { cv::rectangle(top, place, tone, cv::FILLED); };
    paint(part(0, {0, 1}, {0, 1}), {45, 45, 48});
    paint(part(8, {0, 1}, {0, 1}), {45, 45, 48});
    paint(part(0, {0.4, 0.8}, {0.35, 0.65}), {210, 225, 225});
    paint(part(8, {0.2, 0.6}, {0.35, 0.65}), {210, 225, 225});
    for (const double across : {0.04, 0.78})
    {
        paint(part(1, {0.3, 0.8}, {across, across + 0.14}), {40, 35, 170});
        paint(part(7, {0.3, 0.9}, {across, across + 0.18}), {215, 225, 228});
    }
    paint(part(3, {0.1, 0.9}, {0.08, 0.92}), {90, 75, 65});
    paint(part(5, {0.1, 0.9}, {0.06, 0.94}), {100, 85, 75});
    paint(part(6, {0.95, 1}, {0, 1}), scalar(brighter(colour, 0.5)));
    paint(part(7, {0.2, 0.8}, {0.3, 0.7}), {50, 50, 52});
}

/** Side and top of a car in every colour, below each other. */
cv::Mat paint_cars()
{
    const auto width = static_cast<int>(kCarLength * kCarScale);
    const auto count = static_cast<int>(car_colours().size());
    cv::Mat picture(count * kPaintPixels, width, CV_8UC3);
    for (int i = 0; i < count; ++i)
    {
        const auto& colour = car_colours()[static_cast<std::size_t>(i)];
        const auto top = i * kPaintPixels;
        paint_car_side(picture.rowRange(top, top + kSidePixels), colour);
        paint_car_top(picture.rowRange(top + kSidePixels, top + kPaintPixels), colour);
    }
    Lot lot(71);
    shade(picture, fractal_noise(picture.size(), 40, lot), 0.05);
    add_grain(picture, 3, lot);
    return picture;
}

void add_car_body(TexturedMesh& mesh, const PlaceFrame& frame, int colour)
{
    const auto all = static_cast<double>(car_colours().size()) * kPaintPixels;
    const auto side_top = colour * kPaintPixels / all;
    const auto strip_top = side_top + kSidePixels / all;
    const auto strip_height = kTopPixels / all;
    const auto corner = [&](const cv::Point2d& point, double left)
    {
        const cv::Point2d in_picture(point.x / kCarLength,
                                     side_top + (1 - point.y / kCarHeight) * kSidePixels / all);
        return Corner{frame.at(point.x - kCarLength / 2, left, point.y), in_picture};
    };
    const cv::Point2d middle(2, 0.6);
    const auto half = kCarWidth / 2;
    const auto segments = kOutline.size() - 1;
    for (std::size_t i = 0; i <= segments; ++i)
    {
        const auto& a = kOutline[i];
        const auto& b = kOutline[(i + 1) % kOutline.size()];
        mesh.add_triangle(corner(middle, half), corner(a, half), corner(b, half));
        mesh.add_triangle(corner(middle, -half), corner(b, -half), corner(a, -half));
        if (i == segments) break;
        const auto left = static_cast<double>(i) / static_cast<double>(segments);
        const auto right = static_cast<double>(i + 1) / static_cast<double>(segments);
        mesh.add_quad({corner(a, -half).at, {left, strip_top + strip_height}},
                      {corner(b, -half).at, {right, strip_top + strip_height}},
                      {corner(b, half).at, {right, strip_top}},
                      {corner(a, half).at, {left, strip_top}});
    }
}

cv::Mat paint_wheel()
{
    cv::Mat wheel(64, 64, CV_8UC3, cv::Scalar(28, 28, 30));
    cv::circle(wheel, {32, 32}, 20, {150, 152, 155}, cv::FILLED, cv::LINE_AA);
    for (int spoke = 0; spoke < 5; ++spoke)
    {
        const auto angle = 2 * CV_PI * spoke / 5;
        cv::line(wheel,
                 {32, 32},
                 {cvRound(32 + 18 * std::cos(angle)), cvRound(32 + 18 * std::sin(angle))},
                 {50, 50, 52},
                 4,
                 cv::LINE_AA);
    }
    return wheel;
}

void add_wheels(TexturedMesh& mesh, const PlaceFrame& frame)
{
    constexpr int kSides = 14;
    for (const double axle : kAxles)
        for (const double side : {-1.0, 1.0})
            for (int i = 0; i < kSides; ++i)
            {
                const auto rim = [&](int index)
                {
                    const auto angle = side * 2 * CV_PI * index / kSides;
                    const cv::Point2d unit(std::cos(angle), std::sin(angle));
                    return Corner{frame.at(axle - kCarLength / 2 + kWheelRadius * unit.x,
                                           side * (kCarWidth / 2 + 0.02),
                                           kWheelRadius * (1 - unit.y)),
                                  {0.5 + 0.5 * unit.x, 0.5 + 0.5 * unit.y}};
                };
                const Corner hub{
                    frame.at(axle - kCarLength / 2, side * (kCarWidth / 2 + 0.02), kWheelRadius),
                    {0.5, 0.5}};
                mesh.add_triangle(hub, rim(i), rim(i + 1));
            }
}
}  // namespace

void add_trees(mrpt::opengl::COpenGLScene& scene, const std::vector<Place>& trees)
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

void add_lamp_posts(mrpt::opengl::COpenGLScene& scene, const std::vector<Place>& lamp_posts)
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

void add_cars(mrpt::opengl::COpenGLScene& scene, const std::vector<Place>& cars)
{
    TexturedMesh bodies;
    TexturedMesh wheels;
    for (const auto& car : cars)
    {
        Lot lot(car.seed);
        const PlaceFrame frame(car, 0);
        add_car_body(bodies, frame, lot.whole(0, static_cast<int>(car_colours().size()) - 1));
        add_wheels(wheels, frame);
    }
    scene.insert(bodies.object(paint_cars()));
    scene.insert(wheels.object(paint_wheel()));
}

}  // namespace fild
