// SPDX-License-Identifier: BSD-3-Clause
#include "ground.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr double kScale = 25;  // pixels per metre
const Colour kPaint(205, 210, 212);

struct Span
{
    double from = 0;
    double to = 0;
};

/** Turns metres of the town into pixels of the picture of one part of it. */
class GroundMap
{
 public:
    explicit GroundMap(const cv::Rect2d& area) : area_(area) {}

    cv::Size size() const
    {
        return {cvRound(area_.width * kScale), cvRound(area_.height * kScale)};
    }
    cv::Point pixel(const cv::Point2d& metres) const
    {
        return {cvRound((metres.x - area_.x) * kScale),
                cvRound((area_.y + area_.height - metres.y) * kScale)};
    }
    cv::Rect pixels_of(const cv::Rect2d& metres) const
    {
        return {pixel({metres.x, metres.y + metres.height}),
                pixel({metres.x + metres.width, metres.y})};
    }

 private:
    cv::Rect2d area_;
};

/** Paints one part of the ground. */
class GroundPainter
{
 public:
    GroundPainter(const StreetGrid& grid, const cv::Rect2d& area, std::uint64_t seed)
        : grid_(grid), area_(area), map_(area), lot_(seed), canvas_(map_.size(), CV_8UC3)
    {
    }

    void pavement();
    void carriageways();
    void courtyards_and_kerbs();
    void markings();
    void wear();
    cv::Mat canvas() const { return canvas_; }

 private:
    void fill(const cv::Rect2d& metres, const Colour& colour)
    {
        cv::rectangle(canvas_, map_.pixels_of(metres), scalar(colour), cv::FILLED);
    }
    /** A bar along a street: metres forth from a crossing, metres to the left of the middle. */
    void bar(const cv::Point2d& from, const cv::Point2d& forth, const Span& along, const Span& left)
    {
        const cv::Point2d aside(-forth.y, forth.x);
        const auto a = from + along.from * forth + left.from * aside;
        const auto b = from + along.to * forth + left.to * aside;
        fill({cv::Point2d(std::min(a.x, b.x), std::min(a.y, b.y)),
              cv::Point2d(std::max(a.x, b.x), std::max(a.y, b.y))},
             brighter(kPaint, lot_.real(0.85, 1)));
    }
    void mark_street(const cv::Point2d& from, const cv::Point2d& to);
    void zebra(const cv::Point2d& crossing, const cv::Point2d& forth);
    cv::Point somewhere() { return {lot_.whole(0, canvas_.cols), lot_.whole(0, canvas_.rows)}; }
    void manhole();
    void patch();
    void crack();

    const StreetGrid& grid_;
    cv::Rect2d area_;
    GroundMap map_;
    Lot lot_;
    cv::Mat canvas_;
};

void GroundPainter::pavement()
{
    const cv::Size slab(cvRound(0.6 * kScale), cvRound(0.4 * kScale));
    lay_bricks(
        canvas_, cv::Rect({0, 0}, canvas_.size()), slab, {150, 160, 165}, {105, 112, 118}, lot_);
}

void GroundPainter::carriageways()
{
    const Colour asphalt(88, 88, 90);
    const auto end = grid_.crossing(grid_.columns, grid_.rows);
    const auto half = grid_.carriageway / 2;
    for (int i = 0; i <= grid_.columns; ++i)
        fill({grid_.crossing(i, 0).x - half, -half, grid_.carriageway, end.y + 2 * half}, asphalt);
    for (int j = 0; j <= grid_.rows; ++j)
        fill({-half, grid_.crossing(0, j).y - half, end.x + 2 * half, grid_.carriageway}, asphalt);
}

void GroundPainter::courtyards_and_kerbs()
{
    constexpr double kKerbWidth = 0.2;
    const Colour kerb(175, 180, 182);
    const Colour lawn(60, 105, 80);
    for (int i = 0; i < grid_.columns; ++i)
        for (int j = 0; j < grid_.rows; ++j)
        {
            const auto block = grid_.block(i, j);
            const cv::Rect2d pavement(block.x - grid_.pavement,
                                      block.y - grid_.pavement,
                                      block.width + 2 * grid_.pavement,
                                      block.height + 2 * grid_.pavement);
            cv::rectangle(
                canvas_, map_.pixels_of(pavement), scalar(kerb), cvRound(kKerbWidth * kScale));
            fill({block.x + kHouseDepth,
                  block.y + kHouseDepth,
                  block.width - 2 * kHouseDepth,
                  block.height - 2 * kHouseDepth},
                 lawn);
        }
}

void GroundPainter::zebra(const cv::Point2d& crossing, const cv::Point2d& forth)
{
    const auto half = grid_.carriageway / 2;
    for (double left = -half + 0.4; left < half - 0.5; left += 1)
        bar(crossing, forth, {half + 1, half + 3.5}, {left, left + 0.5});
    bar(crossing, forth, {half + 4.2, half + 4.5}, {0, half - 2});
}

void GroundPainter::mark_street(const cv::Point2d& from, const cv::Point2d& to)
{
    const auto length = std::abs(to.x - from.x) + std::abs(to.y - from.y);
    const auto forth = (to - from) / length;
    const auto clear = grid_.carriageway / 2 + 5;
    for (double along = clear; along < length - clear; along += 5)
        bar(from, forth, {along, along + 2.2}, {-0.06, 0.06});
    const auto bay = grid_.carriageway / 2 - 2;
    for (const double side : {-1.0, 1.0})
        for (double along = clear; along < length - clear; along += 6)
        {
            bar(from, forth, {along, along + 0.1}, {side * bay, side * (bay + 2)});
            bar(from, forth, {along, along + 0.8}, {side * bay - 0.05, side * bay + 0.05});
        }
    zebra(from, forth);
    zebra(to, -forth);
}

void GroundPainter::markings()
{
    for (int i = 0; i <= grid_.columns; ++i)
        for (int j = 0; j <= grid_.rows; ++j)
        {
            if (i < grid_.columns) mark_street(grid_.crossing(i, j), grid_.crossing(i + 1, j));
            if (j < grid_.rows) mark_street(grid_.crossing(i, j), grid_.crossing(i, j + 1));
        }
}

void GroundPainter::manhole()
{
    const auto at = somewhere();
    const auto radius = cvRound(0.35 * kScale);
    cv::circle(canvas_, at, radius, {60, 62, 66}, cv::FILLED, cv::LINE_AA);
    cv::circle(canvas_, at, radius, {120, 122, 125}, 1, cv::LINE_AA);
    for (int offset = -radius / 2; offset <= radius / 2; offset += 3)
        cv::line(canvas_,
                 {at.x + offset, at.y - radius / 2},
                 {at.x + offset, at.y + radius / 2},
                 {105, 106, 108});
}

void GroundPainter::patch()
{
    const cv::Size size(cvRound(lot_.real(0.4, 3) * kScale), cvRound(lot_.real(0.4, 3) * kScale));
    const cv::Rect place(somewhere(), size);
    tint(canvas_, place, lot_.real(0.7, 1.2));
    cv::rectangle(canvas_, place, cv::Scalar::all(lot_.real(40, 70)), 1);
}

void GroundPainter::crack()
{
    auto at = somewhere();
    auto angle = lot_.real(0, 2 * CV_PI);
    const auto steps = lot_.whole(4, 14);
    for (int i = 0; i < steps; ++i)
    {
        angle += lot_.real(-0.7, 0.7);
        const auto next = at + cv::Point(cvRound(0.4 * kScale * std::cos(angle)),
                                         cvRound(0.4 * kScale * std::sin(angle)));
        cv::line(canvas_, at, next, {45, 45, 48}, 1, cv::LINE_AA);
        at = next;
    }
}

void GroundPainter::wear()
{
    const auto square_metres = area_.width * area_.height;
    for (int i = 0; i < cvRound(square_metres / 60); ++i) manhole();
    for (int i = 0; i < cvRound(square_metres / 25); ++i) patch();
    for (int i = 0; i < cvRound(square_metres / 12); ++i) crack();
    add_stains(canvas_, cvRound(square_metres / 3), cvRound(0.5 * kScale), lot_);
    shade(canvas_, fractal_noise(canvas_.size(), 4 * kScale, lot_), 0.1);
    add_grain(canvas_, 7, lot_);
}

/** Corners of a house on the ground. */
std::vector<cv::Point2d> footprint(const HouseRow& row, const House& house)
{
    const auto right = house.offset + house.design.width;
    return {row.at(house.offset, 0),
            row.at(right, 0),
            row.at(right, -kHouseDepth),
            row.at(house.offset, -kHouseDepth)};
}
}  // namespace

cv::Mat paint_ground(const TownPlan& plan, const cv::Rect2d& area, std::uint64_t seed)
{
    GroundPainter painter(plan.grid, area, seed);
    painter.pavement();
    painter.carriageways();
    painter.courtyards_and_kerbs();
    painter.markings();
    painter.wear();
    return painter.canvas();
}

void cast_shadows(cv::Mat& canvas,
                  const cv::Rect2d& area,
                  const TownPlan& plan,
                  const cv::Point2d& shadow)
{
    constexpr double kDarkest = 0.55;
    const GroundMap map(area);
    cv::Mat light(canvas.size(), CV_32F, cv::Scalar(1));
    for (const auto& row : plan.rows)
        for (const auto& house : row.houses)
        {
            std::vector<cv::Point> covered;
            for (const auto& corner : footprint(row, house))
            {
                covered.push_back(map.pixel(corner));
                covered.push_back(map.pixel(corner + house.design.height() * shadow));
            }
            std::vector<cv::Point> outline;
            cv::convexHull(covered, outline);
            cv::fillConvexPoly(light, outline, cv::Scalar(kDarkest));
        }
    constexpr double kCrownHeight = 4;
    constexpr double kCrownRadius = 1.5;
    for (const auto& tree : plan.trees)
        cv::circle(light,
                   map.pixel(tree.at + kCrownHeight * shadow),
                   cvRound(kCrownRadius * kScale),
                   cv::Scalar(kDarkest),
                   cv::FILLED);
    cv::blur(light, light, {9, 9});
    shade(canvas, light - 1, 1);
}

void weather_ground(cv::Mat& canvas, const cv::Rect2d& area, const TownPlan& plan, double season)
{
    const GroundMap map(area);
    const cv::Scalar tone(1 - 0.25 * season, 1 - 0.2 * season, 1 - 0.12 * season);
    cv::multiply(canvas, tone, canvas);
    const cv::Rect all({0, 0}, canvas.size());
    for (const auto& tree : plan.trees)
    {
        Lot lot(tree.seed + 3);
        const auto leaves = cvRound(season * lot.real(100, 900));
        for (int i = 0; i < leaves; ++i)
        {
            const auto out = 4.5 * lot.real(0, 1) * lot.real(0.2, 1);
            const auto azimuth = lot.real(0, 2 * CV_PI);
            const cv::Point2d beside(out * std::cos(azimuth), out * std::sin(azimuth));
            const auto at = map.pixel(tree.at + beside);
            const cv::Scalar leaf(lot.real(15, 50), lot.real(60, 150), lot.real(120, 205));
            if (all.contains(at)) cv::circle(canvas, at, lot.whole(1, 3), leaf, cv::FILLED);
        }
    }
}

}  // namespace fild
