// SPDX-License-Identifier: BSD-3-Clause
#include "car_models.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace fild
{
namespace
{
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
    for (const double axle : kCarAxles)
        cv::circle(side_,
                   pixel({axle, kCarWheelRadius}),
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
}  // namespace

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

cv::Mat paint_cars()
{
    const auto width = static_cast<int>(kCarLength * kCarScale);
    cv::Mat picture(kCarModels * kCarPixels, width, CV_8UC3);
    for (int i = 0; i < kCarModels; ++i)
    {
        const auto model = car_model(i);
        const auto top = i * kCarPixels;
        CarSidePainter(picture.rowRange(top, top + kCarSidePixels), model).paint();
        CarTopPainter(picture.rowRange(top + kCarSidePixels, top + kCarPixels), model).paint();
    }
    Lot lot(71);
    add_stains(picture, 20 * kCarModels, 12, lot);
    shade(picture, fractal_noise(picture.size(), 40, lot), 0.07);
    add_grain(picture, 3, lot);
    return picture;
}

}  // namespace fild
