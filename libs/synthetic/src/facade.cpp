// SPDX-License-Identifier: BSD-3-Clause
#include "facade.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>

namespace fild
{
namespace
{
/** Paints one house front from the ground up. Coordinates in metres, x from the left edge, y
 *  downwards from the top. */
class FacadePainter
{
 public:
    FacadePainter(const FacadeDesign& design, const cv::Size2d& size, std::uint64_t wear)
        : design_(design),
          size_(size),
          wear_(wear),
          canvas_(pixels(size.height), pixels(size.width), CV_8UC3)
    {
    }

    void wall();
    void floors();
    void ground_floor();
    void cornice();
    void age();
    void soot();
    cv::Mat canvas() const { return canvas_; }

 private:
    void fill(const cv::Rect2d& metres, const Colour& colour)
    {
        cv::rectangle(canvas_, pixels(metres), scalar(colour), cv::FILLED);
    }
    void window(const cv::Rect2d& place);
    void glass(const cv::Rect2d& pane);
    void curtains(const cv::Rect2d& pane);
    void bars(const cv::Rect2d& pane);
    void shutters(const cv::Rect2d& place);
    void sill(const cv::Rect2d& place);
    void balcony(double floor_y);
    void door(const cv::Rect2d& place);
    void shop_front();
    void shop_sign(const cv::Rect2d& board);
    void awning(double y);
    double top_of_floor(int floor) const
    {
        return size_.height - (floor + 1) * design_.floor_height;
    }

    const FacadeDesign& design_;
    cv::Size2d size_;
    Lot wear_;
    cv::Mat canvas_;
};

void FacadePainter::wall()
{
    const cv::Rect all({0, 0}, canvas_.size());
    const auto joint = brighter(design_.wall_colour, 0.72);
    switch (design_.wall)
    {
        case WallKind::brick:
            lay_bricks(canvas_, all, {10, 4}, design_.wall_colour, joint, wear_);
            break;
        case WallKind::ashlar:
            lay_bricks(canvas_, all, {26, 14}, design_.wall_colour, joint, wear_);
            break;
        case WallKind::boards:
            lay_bricks(canvas_, all, {160, 7}, design_.wall_colour, joint, wear_);
            break;
        case WallKind::plaster:
            canvas_ = scalar(design_.wall_colour);
            break;
    }
}

void FacadePainter::glass(const cv::Rect2d& pane)
{
    const auto area = pixels(pane);
    const double sky = wear_.real(60, 130);
    for (int y = area.y; y < area.br().y; ++y)
    {
        const double shade = sky * (1 - 0.5 * (y - area.y) / std::max(1, area.height));
        cv::line(canvas_, {area.x, y}, {area.br().x - 1, y}, {shade, shade * 0.9, shade * 0.8});
    }
    const auto visible = area & cv::Rect({0, 0}, canvas_.size());
    cv::Mat part = canvas_(visible);
    cv::Mat lit = part.clone();
    const std::vector<cv::Point> reflection{cv::Point(wear_.whole(0, area.width), 0),
                                            cv::Point(area.width, wear_.whole(0, area.height)),
                                            cv::Point(wear_.whole(0, area.width), area.height)};
    cv::fillConvexPoly(lit, reflection, cv::Scalar(190, 180, 165), cv::LINE_AA);
    cv::addWeighted(lit, 0.35, part, 0.65, 0, part);
}

void FacadePainter::curtains(const cv::Rect2d& pane)
{
    if (wear_.chance(0.25)) return;
    const Colour cloth = brighter(wear_.pick(wall_colours()), wear_.real(0.9, 1.25));
    if (wear_.chance(0.3))  // a blind
    {
        const auto drop = pane.height * wear_.real(0.2, 0.9);
        fill({pane.x, pane.y, pane.width, drop}, cloth);
        for (double y = 0.1; y < drop; y += 0.1)
            fill({pane.x, pane.y + y, pane.width, 0.03}, brighter(cloth, 0.75));
        return;
    }
    const auto width = pane.width * wear_.real(0.12, 0.35);
    for (const auto x : {pane.x, pane.x + pane.width - width})
    {
        fill({x, pane.y, width, pane.height}, cloth);
        for (double fold = 0.08; fold < width; fold += 0.12)
            fill({x + fold, pane.y, 0.03, pane.height}, brighter(cloth, 0.7));
    }
}

void FacadePainter::bars(const cv::Rect2d& pane)
{
    constexpr double kBar = 0.05;
    const auto& colour = design_.trim_colour;
    const auto middle = pane.x + pane.width / 2 - kBar / 2;
    const bool crossed = design_.window != WindowKind::wide;
    if (design_.window != WindowKind::sash) fill({middle, pane.y, kBar, pane.height}, colour);
    if (crossed)
    {
        const auto share = design_.window == WindowKind::sash ? 0.5 : 0.32;
        fill({pane.x, pane.y + pane.height * share, pane.width, kBar}, colour);
    }
    if (design_.window == WindowKind::wide)
        for (const double share : {0.25, 0.75})
            fill({pane.x + pane.width * share, pane.y, kBar, pane.height}, colour);
}

void FacadePainter::shutters(const cv::Rect2d& place)
{
    const auto width = place.width * 0.42;
    for (const auto x : {place.x - width - 0.05, place.x + place.width + 0.05})
    {
        fill({x, place.y, width, place.height}, design_.accent_colour);
        for (double y = 0.06; y < place.height - 0.05; y += 0.1)
            fill({x + 0.06, place.y + y, width - 0.12, 0.04}, brighter(design_.accent_colour, 1.5));
    }
}

void FacadePainter::sill(const cv::Rect2d& place)
{
    const cv::Rect2d stone(place.x - 0.12, place.y + place.height + 0.06, place.width + 0.24, 0.1);
    fill(stone, brighter(design_.trim_colour, 0.95));
    tint(canvas_, pixels(cv::Rect2d(stone.x, stone.y + 0.1, stone.width, 0.1)), 0.6);
    const auto streaks = wear_.whole(0, 3);
    for (int i = 0; i < streaks; ++i)
        tint(canvas_,
             pixels(cv::Rect2d(stone.x + wear_.real(0, stone.width),
                               stone.y + 0.2,
                               wear_.real(0.03, 0.15),
                               wear_.real(0.3, 1.2))),
             wear_.real(0.75, 0.92));
    if (!wear_.chance(0.22)) return;
    const auto pots = wear_.whole(3, 9);  // flowers on the sill
    for (int i = 0; i < pots; ++i)
        cv::circle(canvas_,
                   cv::Point(pixels(stone.x + wear_.real(0.05, stone.width)),
                             pixels(stone.y - wear_.real(0, 0.2))),
                   wear_.whole(2, 4),
                   wear_.chance(0.5) ? cv::Scalar(40, 110, 50)
                                     : cv::Scalar(wear_.real(40, 200), 40, wear_.real(120, 240)),
                   cv::FILLED,
                   cv::LINE_AA);
}

void FacadePainter::window(const cv::Rect2d& place)
{
    constexpr double kFrame = 0.1;
    fill({place.x - 0.18, place.y - 0.2, place.width + 0.36, place.height + 0.26},
         brighter(design_.wall_colour, design_.wall == WallKind::plaster ? 1.12 : 1.2));
    if (design_.window == WindowKind::shuttered) shutters(place);
    fill({place.x - kFrame, place.y - kFrame, place.width + 2 * kFrame, place.height + 2 * kFrame},
         design_.trim_colour);
    glass(place);
    curtains(place);
    bars(place);
    tint(canvas_, pixels(cv::Rect2d(place.x, place.y, place.width, 0.1)), 0.6);
    if (design_.window == WindowKind::arched)
        cv::ellipse(canvas_,
                    cv::Point(pixels(place.x + place.width / 2), pixels(place.y - kFrame)),
                    cv::Size(pixels(place.width / 2 + 0.15), pixels(0.35)),
                    0,
                    180,
                    360,
                    scalar(brighter(design_.accent_colour, 1.2)),
                    cv::FILLED,
                    cv::LINE_AA);
    sill(place);
}

void FacadePainter::balcony(double floor_y)
{
    const cv::Rect2d slab(0.6, floor_y + design_.floor_height - 0.15, size_.width - 1.2, 0.18);
    const auto iron = brighter(design_.accent_colour, 0.6);
    for (double x = slab.x; x < slab.x + slab.width; x += 0.14)
        fill({x, slab.y - 0.95, 0.04, 0.95}, iron);
    fill({slab.x, slab.y - 1, slab.width, 0.07}, iron);
    fill(slab, brighter(design_.trim_colour, 0.85));
    tint(canvas_, pixels(cv::Rect2d(slab.x, slab.y + 0.18, slab.width, 0.25)), 0.65);
}

void FacadePainter::floors()
{
    const auto pitch = size_.width / design_.windows_per_floor;
    const auto& opening = design_.window_size;
    for (int floor = 1; floor < design_.floors; ++floor)
    {
        const auto y = top_of_floor(floor);
        for (int i = 0; i < design_.windows_per_floor; ++i)
            window(
                {(i + 0.5) * pitch - opening.width / 2, y + 0.55, opening.width, opening.height});
        fill({0, y + design_.floor_height - 0.06, size_.width, 0.1},
             brighter(design_.trim_colour, 0.8));
        if (floor == design_.balcony_floor) balcony(y);
    }
}

void FacadePainter::door(const cv::Rect2d& place)
{
    fill({place.x - 0.15, place.y - 0.15, place.width + 0.3, place.height + 0.15},
         design_.trim_colour);
    fill(place, design_.accent_colour);
    for (const double x : {0.1, 0.55})
        for (const double y : {0.08, 0.4, 0.7})
            fill({place.x + place.width * x,
                  place.y + place.height * y,
                  place.width * 0.35,
                  place.height * 0.22},
                 brighter(design_.accent_colour, 1.45));
    fill({place.x + place.width * 0.47, place.y, 0.04, place.height},
         brighter(design_.accent_colour, 0.4));
    cv::putText(canvas_,
                std::to_string(wear_.whole(1, 199)),
                cv::Point(pixels(place.x + place.width + 0.2), pixels(place.y + 0.4)),
                cv::FONT_HERSHEY_DUPLEX,
                0.45,
                scalar(brighter(design_.accent_colour, 0.5)),
                1,
                cv::LINE_AA);
}

void FacadePainter::shop_sign(const cv::Rect2d& board)
{
    fill(board, brighter(design_.accent_colour, 1.1));
    fill({board.x, board.y, board.width, 0.05}, design_.trim_colour);
    fill({board.x, board.y + board.height - 0.05, board.width, 0.05}, design_.trim_colour);
    int baseline = 0;
    const auto unit = cv::getTextSize(design_.sign, cv::FONT_HERSHEY_TRIPLEX, 1, 2, &baseline);
    const auto scale =
        std::min(0.8 * pixels(board.width) / unit.width, 0.6 * pixels(board.height) / unit.height);
    const cv::Point start(pixels(board.x + board.width / 2) - cvRound(scale * unit.width / 2),
                          pixels(board.y + board.height / 2) + cvRound(scale * unit.height / 2));
    cv::putText(canvas_,
                design_.sign,
                start,
                cv::FONT_HERSHEY_TRIPLEX,
                scale,
                {225, 240, 245},
                2,
                cv::LINE_AA);
}

void FacadePainter::awning(double y)
{
    constexpr double kStripe = 0.3;
    int index = 0;
    for (double x = 0.3; x < size_.width - 0.4; x += kStripe, ++index)
    {
        const Colour cloth =
            index % 2 == 0 ? Colour(225, 230, 235) : brighter(design_.accent_colour, 1.4);
        const auto width = std::min(kStripe, size_.width - 0.3 - x);
        fill({x, y, width, 0.65}, cloth);
        cv::circle(canvas_,
                   cv::Point(pixels(x + width / 2), pixels(y + 0.65)),
                   pixels(width / 2),
                   scalar(brighter(cloth, 0.85)),
                   cv::FILLED,
                   cv::LINE_AA);
    }
    tint(canvas_, pixels(cv::Rect2d(0.2, y + 0.8, size_.width - 0.4, 0.5)), 0.7);
}

void FacadePainter::shop_front()
{
    const auto top = top_of_floor(0);
    fill({0.15, top + 0.1, size_.width - 0.3, design_.floor_height - 0.1},
         brighter(design_.accent_colour, 0.8));
    const auto panes = std::max(2, cvRound(size_.width / 2.4));
    const auto pitch = (size_.width - 0.6) / panes;
    for (int i = 0; i < panes; ++i)
    {
        const cv::Rect2d pane(0.4 + i * pitch, top + 0.85, pitch - 0.2, 1.65);
        if (i == panes / 2)
        {
            door({pane.x, pane.y, pane.width, design_.floor_height - 0.85});
            continue;
        }
        glass(pane);
        const auto goods = wear_.whole(8, 20);
        for (int k = 0; k < goods; ++k)
            fill({pane.x + wear_.real(0.05, pane.width - 0.3),
                  pane.y + wear_.real(0.4, 1.3),
                  wear_.real(0.08, 0.25),
                  wear_.real(0.1, 0.3)},
                 brighter(wear_.pick(wall_colours()), wear_.real(0.6, 1.2)));
    }
    shop_sign({0.3, top + 0.12, size_.width - 0.6, 0.62});
    if (design_.awning) awning(top + 0.8);
}

void FacadePainter::ground_floor()
{
    const auto top = top_of_floor(0);
    if (design_.shop)
    {
        shop_front();
        return;
    }
    lay_bricks(canvas_,
               pixels(cv::Rect2d(0, size_.height - 0.9, size_.width, 0.9)),
               {30, 12},
               brighter(design_.wall_colour, 0.75),
               brighter(design_.wall_colour, 0.5),
               wear_);
    const auto pitch = size_.width / design_.windows_per_floor;
    for (int i = 0; i < design_.windows_per_floor; ++i)
    {
        const auto middle = (i + 0.5) * pitch;
        if (i == design_.windows_per_floor / 2)
            door({middle - 0.55, top + 0.7, 1.1, design_.floor_height - 0.7});
        else
            window({middle - design_.window_size.width / 2,
                    top + 0.6,
                    design_.window_size.width,
                    std::min(design_.window_size.height, 1.5)});
    }
}

void FacadePainter::cornice()
{
    for (const auto& [y, height, tone] :
         {std::array{0.0, 0.25, 0.95}, {0.25, 0.08, 0.6}, {0.33, 0.2, 0.85}, {0.53, 0.06, 0.5}})
        fill({0, y, size_.width, height}, brighter(design_.trim_colour, tone));
    for (double x = 0.1; x < size_.width; x += 0.4)
        fill({x, 0.33, 0.18, 0.18}, brighter(design_.trim_colour, 1.1));
}

void FacadePainter::age()
{
    const auto pipe = wear_.chance(0.5) ? 0.15 : size_.width - 0.3;
    fill({pipe, 0.5, 0.12, size_.height - 0.5}, brighter(design_.trim_colour, 0.6));
    fill({pipe + 0.03, 0.5, 0.03, size_.height - 0.5}, brighter(design_.trim_colour, 0.9));
    add_stains(canvas_, wear_.whole(10, 40), pixels(0.5), wear_);
    shade(canvas_, fractal_noise(canvas_.size(), pixels(3), wear_), 0.06);
    add_grain(canvas_, 5, wear_);
    if (design_.soot > 0) soot();
    tint(canvas_, {0, canvas_.rows - pixels(0.25), canvas_.cols, pixels(0.25)}, 0.75);
}

/** Dark in large clouds, with streaks of rain. */
void FacadePainter::soot()
{
    shade(canvas_, fractal_noise(canvas_.size(), pixels(5), wear_), 0.25 * design_.soot);
    tint(canvas_, cv::Rect({0, 0}, canvas_.size()), 1 - 0.3 * design_.soot);
    const auto streaks = cvRound(size_.width * 4 * design_.soot);
    for (int i = 0; i < streaks; ++i)
        tint(canvas_,
             pixels(cv::Rect2d(wear_.real(0, size_.width),
                               wear_.real(0, size_.height / 2),
                               wear_.real(0.05, 0.3),
                               wear_.real(1, 5))),
             wear_.real(0.8, 1.1));
}
}  // namespace

cv::Mat paint_facade(const FacadeDesign& design, double width, std::uint64_t wear)
{
    FacadePainter painter(design, {width, design.height()}, wear);
    painter.wall();
    painter.floors();
    painter.ground_floor();
    painter.cornice();
    painter.age();
    return painter.canvas();
}

cv::Mat paint_blank_wall(const FacadeDesign& design, const cv::Size2d& size, std::uint64_t wear)
{
    FacadePainter painter(design, size, wear);
    painter.wall();
    painter.age();
    return painter.canvas();
}

}  // namespace fild
