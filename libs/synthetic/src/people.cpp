// SPDX-License-Identifier: BSD-3-Clause
#include "people.h"

#include "solids.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fild
{
namespace
{
constexpr int kLooks = 24;  // different people
constexpr int kColumns = 6;  // of looks in the picture
constexpr int kCell = 160;  // pixels, width and height of a look

/** Parts of a look, pixels in its cell. The middle of each is the front of the body. */
const cv::Rect kTop(0, 0, 96, 100);
const cv::Rect kTrousers(96, 0, 32, 100);
const cv::Rect kSleeve(128, 0, 32, 100);
const cv::Rect kHead(0, 100, 96, 60);
const cv::Rect kShoe(96, 100, 32, 60);
const cv::Rect kBag(128, 100, 32, 60);

cv::Point cell_of(int look)
{
    return {look % kColumns * kCell, look / kColumns * kCell};
}

/** A part of a look's cell as a share of the whole picture; its outermost pixels are left out. */
cv::Rect2d part_of(int look, const cv::Rect& part)
{
    constexpr double kWidth = 1.0 * kColumns * kCell;
    constexpr double kHeight = 1.0 * kLooks / kColumns * kCell;
    const auto corner = cell_of(look) + part.tl();
    return {(corner.x + 1) / kWidth,
            (corner.y + 1) / kHeight,
            (part.width - 2) / kWidth,
            (part.height - 2) / kHeight};
}

const std::vector<Colour>& cloth_colours()
{
    static const std::vector<Colour> colours{{50, 45, 42},
                                             {110, 70, 40},
                                             {40, 40, 150},
                                             {60, 110, 70},
                                             {190, 190, 195},
                                             {70, 140, 190},
                                             {150, 130, 60},
                                             {90, 50, 90},
                                             {40, 90, 200},
                                             {120, 120, 118},
                                             {60, 70, 100},
                                             {160, 190, 210}};
    return colours;
}

/** Paints one look into its cell. */
class LookPainter
{
 public:
    LookPainter(const cv::Mat& cell, std::uint64_t seed) : cell_(cell), lot_(seed)
    {
        skin_ =
            lot_.pick<Colour>({{150, 180, 225}, {120, 155, 205}, {80, 110, 160}, {50, 70, 105}});
        hair_ = lot_.pick<Colour>(
            {{25, 28, 32}, {35, 55, 80}, {60, 110, 160}, {150, 155, 160}, {30, 50, 110}});
    }
    void paint();

 private:
    void fill(const cv::Rect& part, const Colour& colour)
    {
        cv::rectangle(cell_, part, scalar(colour), cv::FILLED);
    }
    void folds(const cv::Rect& part, int count);
    void top();
    void head();

    cv::Mat cell_;
    Lot lot_;
    Colour skin_;
    Colour hair_;
};

void LookPainter::folds(const cv::Rect& part, int count)
{
    for (int i = 0; i < count; ++i)
        tint(cell_,
             {part.x + lot_.whole(0, part.width - 3),
              part.y + lot_.whole(0, part.height - 25),
              2,
              lot_.whole(10, 25)},
             lot_.real(0.75, 1.2));
}

void LookPainter::top()
{
    const auto cloth = brighter(lot_.pick(cloth_colours()), lot_.real(0.8, 1.15));
    fill(kTop, cloth);
    fill(kSleeve, cloth);
    if (lot_.chance(0.3))  // stripes
        for (int y = 4; y < kTop.height; y += 12)
            for (const auto& part : {kTop, kSleeve})
                fill({part.x, y, part.width, 5}, brighter(cloth, 0.6));
    folds(kTop, 14);
    folds(kSleeve, 6);
    const int middle = kTop.width / 2;
    if (lot_.chance(0.6))  // an open jacket over a shirt
        fill({middle - 7, 0, 14, 80}, brighter(lot_.pick(cloth_colours()), 1.1));
    fill({middle, 0, 1, kTop.height}, brighter(cloth, 0.5));
    fill({middle - 10, 0, 20, 6}, skin_);  // the neck
    fill({0, kTop.height - 8, kTop.width, 6}, brighter(cloth, 0.55));
    fill({kSleeve.x, kSleeve.height - 12, kSleeve.width, 12}, skin_);  // the hands
}

void LookPainter::head()
{
    fill(kHead, skin_);
    const int top = kHead.y;
    const int middle = kHead.x + kHead.width / 2;
    fill({kHead.x, top, kHead.width, 18}, hair_);
    const int hair_ends = lot_.whole(34, 56);
    fill({kHead.x, top, 26, hair_ends}, hair_);
    fill({kHead.x + kHead.width - 26, top, 26, hair_ends}, hair_);
    for (const int side : {-1, 1})
    {
        fill({middle + side * 8 - 2, top + 28, 4, 3}, {40, 40, 45});
        fill({middle + side * 8 - 3, top + 24, 6, 2}, hair_);
    }
    fill({middle - 1, top + 30, 3, 8}, brighter(skin_, 0.85));
    fill({middle - 5, top + 43, 10, 3}, {90, 90, 150});
}

void LookPainter::paint()
{
    const auto trousers = brighter(lot_.pick(cloth_colours()), lot_.real(0.6, 0.9));
    top();
    head();
    fill(kTrousers, trousers);
    folds(kTrousers, 8);
    fill({kTrousers.x, kTrousers.height - 8, kTrousers.width, 8}, brighter(trousers, 0.6));
    fill(kShoe, brighter(lot_.pick(cloth_colours()), 0.5));
    const auto bag = lot_.pick(cloth_colours());
    fill(kBag, bag);
    fill({kBag.x, kBag.y + 20, kBag.width, 4}, brighter(bag, 0.5));
    fill({kBag.x + 8, kBag.y + 30, 16, 18}, brighter(bag, 0.75));
}

/** A cross-section of a body: where it is, and its half axes; shares of the height. */
struct Level
{
    double ahead = 0;
    double up = 0;
    double half_depth = 0;
    double half_width = 0;
};

/** A body of some height: turns shares of the height into points of the town. */
class Body
{
 public:
    Body(TexturedMesh& mesh, const StandingObject& person, double stride)
        : mesh_(mesh),
          frame_(person, kKerbHeight),
          lot_(person.seed),
          swing_(std::sin(2 * CV_PI * stride))
    {
        look_ = lot_.whole(0, kLooks - 1);
        height_ = lot_.chance(0.12) ? lot_.real(1.1, 1.4) : lot_.real(1.58, 1.88);
        breadth_ = lot_.real(0.9, 1.2);
    }
    void add();

 private:
    cv::Point3d at(double ahead, double left, double up) const
    {
        return frame_.at(height_ * ahead, height_ * left, height_ * up);
    }
    Ring ring(double ahead, double up, double half_depth, double half_width) const;
    void add_leg(double side);
    void add_arm(double side);
    void add_trunk(bool coat);
    void add_head();
    void add_bag();

    TexturedMesh& mesh_;
    PlaceFrame frame_;
    Lot lot_;
    double swing_;
    int look_ = 0;
    double height_ = 0;  ///< m
    double breadth_ = 1;
};

Ring Body::ring(double ahead, double up, double half_depth, double half_width) const
{
    const auto centre = at(ahead, 0, up);
    return {centre,
            at(ahead + breadth_ * half_depth, 0, up) - centre,
            at(ahead, breadth_ * half_width, up) - centre};
}

void Body::add_leg(double side)
{
    const double step = side * swing_;
    const double lift = std::max(0.0, -0.03 * step);
    const double foot = 0.17 * step;
    const auto hip = at(0, side * 0.052, 0.5);
    const auto knee = at(0.085 * step + 0.012, side * 0.055, 0.27 + 0.5 * lift);
    const auto ankle = at(foot, side * 0.055, 0.045 + lift);
    add_limb(mesh_,
             {{ankle, 0.032 * height_}, {knee, 0.042 * height_}, {hip, 0.062 * height_}},
             part_of(look_, kTrousers));
    const auto sole = 0.02 + lift;
    add_limb(mesh_,
             {{at(foot - 0.04, side * 0.055, sole), 0.01 * height_},
              {at(foot - 0.03, side * 0.055, sole), 0.026 * height_},
              {at(foot + 0.06, side * 0.06, sole), 0.026 * height_},
              {at(foot + 0.1, side * 0.06, sole), 0.008 * height_}},
             part_of(look_, kShoe));
}

void Body::add_arm(double side)
{
    const double step = -side * swing_;
    const double out = side * breadth_;
    add_limb(mesh_,
             {{at(0.13 * step + 0.05, out * 0.14, 0.46), 0.012 * height_},
              {at(0.1 * step + 0.03, out * 0.142, 0.5), 0.024 * height_},
              {at(0.04 * step - 0.01, out * 0.14, 0.64), 0.029 * height_},
              {at(0, out * 0.118, 0.79), 0.034 * height_},
              {at(0, out * 0.1, 0.812), 0.012 * height_}},
             part_of(look_, kSleeve));
}

void Body::add_trunk(bool coat)
{
    std::vector<Ring> rings;
    if (coat) rings.push_back(ring(0, 0.32, 0.085, 0.115));
    for (const auto& [ahead, up, depth, width] : {Level{0, 0.47, 0.068, 0.095},
                                                  Level{0.005, 0.58, 0.06, 0.084},
                                                  Level{0.008, 0.7, 0.07, 0.104},
                                                  Level{0, 0.78, 0.062, 0.118},
                                                  Level{0, 0.815, 0.048, 0.1},
                                                  Level{0, 0.835, 0.035, 0.042},
                                                  Level{0.005, 0.87, 0.03, 0.032}})
        rings.push_back(ring(ahead, up, depth, width));
    add_tube(mesh_, rings, part_of(look_, kTop));
}

void Body::add_head()
{
    std::vector<Ring> rings;
    for (const auto& [ahead, up, depth, width] : {Level{0.012, 0.855, 0.012, 0.012},
                                                  Level{0.012, 0.865, 0.04, 0.032},
                                                  Level{0.012, 0.895, 0.052, 0.042},
                                                  Level{0.012, 0.935, 0.057, 0.046},
                                                  Level{0.012, 0.97, 0.05, 0.041},
                                                  Level{0.012, 0.99, 0.03, 0.026},
                                                  Level{0.012, 1, 0.004, 0.004}})
    {
        auto level = ring(ahead, up, depth, width);
        level.ahead *= 1 / breadth_;  // heads differ less than bodies
        level.left *= 1 / breadth_;
        rings.push_back(level);
    }
    add_tube(mesh_, rings, part_of(look_, kHead));
}

void Body::add_bag()
{
    add_tube(mesh_,
             {ring(-0.1, 0.57, 0.01, 0.03),
              ring(-0.1, 0.58, 0.042, 0.075),
              ring(-0.1, 0.74, 0.042, 0.07),
              ring(-0.09, 0.78, 0.01, 0.03)},
             part_of(look_, kBag));
}

void Body::add()
{
    for (const double side : {-1.0, 1.0})
    {
        add_leg(side);
        add_arm(side);
    }
    add_trunk(lot_.chance(0.35));
    add_head();
    if (lot_.chance(0.35)) add_bag();
}
}  // namespace

cv::Mat paint_people()
{
    cv::Mat picture(kLooks / kColumns * kCell, kColumns * kCell, CV_8UC3);
    for (int look = 0; look < kLooks; ++look)
        LookPainter(picture(cv::Rect(cell_of(look), cv::Size(kCell, kCell))),
                    static_cast<std::uint64_t>(900 + look))
            .paint();
    Lot lot(73);
    shade(picture, fractal_noise(picture.size(), 16, lot), 0.07);
    add_grain(picture, 4, lot);
    return picture;
}

void add_person(TexturedMesh& mesh, const StandingObject& person, double stride)
{
    Body(mesh, person, stride).add();
}

}  // namespace fild
