// SPDX-License-Identifier: BSD-3-Clause
#include "lorries.h"

#include "solids.h"
#include "wheels.h"

#include <opencv2/imgproc.hpp>

#include <string>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
constexpr double kHeight = 3;  // m, of the tallest
constexpr int kScale = 80;  // pixels per metre
constexpr int kModelsOfAKind = 5;
constexpr int kModels = 2 * kModelsOfAKind;  // delivery lorries first
constexpr int kFaces = 11;  // around the outlines; the last one is that of the frame below
constexpr int kWidthPixels = static_cast<int>(kLorryLength * kScale);
constexpr int kSidePixels = static_cast<int>(kHeight * kScale);
constexpr int kFacePixels = static_cast<int>(kLorryWidth * kScale);
constexpr int kModelPixels = 2 * kSidePixels + kFacePixels;
constexpr double kWheelRadius = 0.42;

/** Outline of a part from the side, clockwise from its lower rear corner: metres from the rear,
 *  metres over the road. */
struct Part
{
    std::vector<cv::Point2d> outline;  ///< convex
    int first_face = 0;  ///< in the picture, of the edge from the first corner to the second
    double width = kLorryWidth;  ///< m
    bool all_one_face = false;  ///< its edges show the first face all
};

const std::vector<Part>& parts_of(LorryKind kind)
{
    static const std::vector<Part> delivery{
        {{{0, 0.7}, {0, 2.88}, {0.05, 2.95}, {4.45, 2.95}, {4.5, 0.7}}, 0},
        {{{4.58, 0.35},
          {4.58, 2.2},
          {4.75, 2.32},
          {5.5, 2.32},
          {6.1, 1.4},
          {6.45, 1.2},
          {6.5, 0.35}},
         4},
        {{{0.1, 0.4}, {0.1, 0.7}, {4.7, 0.7}, {4.7, 0.4}}, kFaces - 1, 0.9, true},
        {{{0.02, 0.42}, {0.02, 0.56}, {0.12, 0.56}, {0.12, 0.42}}, kFaces - 1, 1.9, true}};
    static const std::vector<Part> bus{{{{0.05, 0.35},
                                         {0, 1.2},
                                         {0.08, 2.6},
                                         {0.35, 2.8},
                                         {6.1, 2.8},
                                         {6.3, 2.6},
                                         {6.48, 1.2},
                                         {6.42, 0.35}},
                                        0}};
    return kind == LorryKind::delivery ? delivery : bus;
}

const std::vector<Colour>& stripe_colours()
{
    static const std::vector<Colour> colours{
        {150, 60, 30}, {40, 40, 160}, {60, 120, 60}, {60, 150, 210}, {60, 60, 62}};
    return colours;
}

/** Wheels' distances from the rear, m. */
std::vector<double> axles_of(LorryKind kind)
{
    if (kind == LorryKind::delivery) return {1.2, 5.55};
    return {1.5, 5.3};
}

/** Paints a lorry or a bus, from the top of its picture: the right side, its front to the right;
 * the left side, its front to the left; and a field for each face around the outline, upwards
 * behind, forwards on the roof, downwards in front. */
class LorryPainter
{
 public:
    LorryPainter(const cv::Mat& picture, std::uint64_t seed)
        : side_(picture.rowRange(0, kSidePixels)),
          left_side_(picture.rowRange(kSidePixels, 2 * kSidePixels)),
          faces_(picture.rowRange(2 * kSidePixels, kModelPixels)),
          lot_(seed)
    {
        colour_ = brighter(lot_.pick<Colour>({{215, 220, 222},
                                              {170, 110, 50},
                                              {50, 50, 165},
                                              {60, 120, 70},
                                              {60, 165, 210},
                                              {120, 90, 60}}),
                           lot_.real(0.85, 1.1));
    }
    void delivery();
    void bus();

 private:
    void bar(const cv::Point2d& a, const cv::Point2d& b, const Colour& colour)
    {
        const auto pixel = [](const cv::Point2d& metres)
        { return cv::Point(cvRound(metres.x * kScale), cvRound((kHeight - metres.y) * kScale)); };
        cv::rectangle(side_, pixel(a), pixel(b), scalar(colour), cv::FILLED);
    }
    /** A piece of a face. \param along, across  shares of it. */
    void piece(int face, const cv::Vec2d& along, const cv::Vec2d& across, const Colour& colour)
    {
        const auto step = static_cast<double>(faces_.cols) / kFaces;
        cv::rectangle(
            faces_,
            cv::Rect(
                cv::Point(cvRound((face + along[0]) * step), cvRound(across[0] * faces_.rows)),
                cv::Point(cvRound((face + along[1]) * step), cvRound(across[1] * faces_.rows))),
            scalar(colour),
            cv::FILLED);
    }
    void glass(const cv::Point2d& a, const cv::Point2d& b);
    void lettering();
    void cab();
    void ends(int rear, int front);

    cv::Mat side_;
    cv::Mat left_side_;
    cv::Mat faces_;
    Lot lot_;
    Colour colour_;
};

void LorryPainter::glass(const cv::Point2d& a, const cv::Point2d& b)
{
    const auto tone = lot_.real(50, 100);
    bar(a, b, {30, 30, 30});
    bar(a + cv::Point2d(0.04, 0.04), b - cv::Point2d(0.04, 0.04), {tone, tone * 0.9, tone * 0.8});
    const auto middle = a.x + (b.x - a.x) * lot_.real(0.3, 0.6);
    bar({middle, a.y + 0.1}, {middle + 0.15, b.y - 0.06}, {tone * 1.6, tone * 1.5, tone * 1.4});
}

/** On both sides. */
void LorryPainter::lettering()
{
    const auto ink = scalar(brighter(
        lot_.pick<Colour>({{160, 60, 30}, {30, 30, 150}, {40, 90, 40}}), lot_.real(0.7, 1.2)));
    const auto name =
        lot_.pick<std::string>({"FRESH", "MOVERS", "PARCEL", "DAIRY", "LINEN", "TOOLS"});
    const auto since = "since 19" + std::to_string(lot_.whole(10, 99));
    const auto scale = lot_.real(1.7, 2.2);
    for (const auto& [side, left] : {std::pair(side_, 0.6), std::pair(left_side_, 2.6)})
    {
        const cv::Point at(cvRound(left * kScale), cvRound((kHeight - 1.75) * kScale));
        cv::Mat canvas = side;
        cv::putText(canvas, name, at, cv::FONT_HERSHEY_TRIPLEX, scale, ink, 3, cv::LINE_AA);
        const auto below = at + cv::Point(0, 34);
        cv::putText(canvas, since, below, cv::FONT_HERSHEY_SIMPLEX, 0.7, ink, 1, cv::LINE_AA);
    }
}

void LorryPainter::cab()
{
    const auto paint =
        brighter(lot_.pick<Colour>({{215, 220, 222}, {60, 50, 45}, {40, 40, 150}}), 1);
    bar({4.52, 0.3}, {6.5, 2.4}, paint);
    glass({4.85, 1.4}, {5.65, 2.15});
    bar({4.8, 1.35}, {4.83, 0.5}, brighter(paint, 0.5));
    bar({5.75, 1.35}, {5.78, 0.6}, brighter(paint, 0.5));
    bar({4.9, 1.2}, {5.1, 1.14}, brighter(paint, 0.4));
    bar({4.55, 0.3}, {6.5, 0.5}, {40, 40, 42});
    bar({6.25, 0.95}, {6.5, 0.75}, {215, 225, 228});
    for (int face = 4; face < kFaces - 1; ++face) piece(face, {0, 1}, {0, 1}, paint);
    piece(7, {0.1, 0.92}, {0.06, 0.94}, {85, 75, 68});  // the windscreen
    piece(9, {0.1, 0.4}, {0.08, 0.22}, {215, 225, 228});
    piece(9, {0.1, 0.4}, {0.78, 0.92}, {215, 225, 228});
    piece(9, {0.05, 0.5}, {0.3, 0.7}, {45, 45, 48});
    piece(9, {0.7, 0.85}, {0.38, 0.62}, {210, 225, 225});
}

void LorryPainter::delivery()
{
    side_ = scalar(colour_);
    faces_ = scalar(colour_);
    for (double x = 0.5; x < 4.4; x += lot_.real(0.5, 0.7))
        bar({x, 0.75}, {x + 0.02, 2.9}, brighter(colour_, 0.85));
    if (lot_.chance(0.6)) bar({0, 0.95}, {4.5, 1.25}, brighter(lot_.pick(stripe_colours()), 1));
    bar({0, 0.3}, {4.5, 0.8}, {50, 50, 52});
    for (double x = 0.3; x < 4.4; x += 1.3) bar({x, 0.84}, {x + 0.1, 0.9}, {40, 120, 220});
    // Two doors behind, with hinges, bars and lamps.
    piece(0, {0, 0.06}, {0, 1}, {45, 45, 48});
    piece(0, {0.06, 0.12}, {0.03, 0.14}, {40, 35, 160});
    piece(0, {0.06, 0.12}, {0.86, 0.97}, {40, 35, 160});
    piece(0, {0, 1}, {0.495, 0.505}, brighter(colour_, 0.4));
    for (const double across : {0.25, 0.4, 0.6, 0.75})
        piece(0, {0.08, 0.95}, {across, across + 0.015}, brighter(colour_, 0.6));
    piece(0, {0.3, 0.36}, {0.36, 0.48}, {70, 70, 72});
    piece(0, {0.01, 0.05}, {0.4, 0.6}, {210, 225, 225});
    cab();
    piece(kFaces - 1, {0, 1}, {0, 1}, {42, 42, 45});
    cv::flip(side_, left_side_, 1);
    lettering();
}

void LorryPainter::ends(int rear, int front)
{
    piece(rear, {0, 1}, {0, 1}, brighter(colour_, 0.8));
    piece(rear + 1, {0.3, 0.95}, {0.1, 0.9}, {90, 80, 72});
    piece(rear, {0.4, 0.8}, {0.04, 0.12}, {40, 35, 160});
    piece(rear, {0.4, 0.8}, {0.88, 0.96}, {40, 35, 160});
    piece(rear, {0.3, 0.45}, {0.38, 0.62}, {210, 225, 225});
    piece(front - 1, {0.1, 0.95}, {0.05, 0.95}, {85, 75, 68});
    piece(front - 2, {0.2, 0.9}, {0.2, 0.8}, {35, 35, 38});
    piece(front, {0.1, 0.4}, {0.06, 0.2}, {215, 225, 228});
    piece(front, {0.1, 0.4}, {0.8, 0.94}, {215, 225, 228});
    piece(front, {0.6, 0.75}, {0.38, 0.62}, {210, 225, 225});
}

void LorryPainter::bus()
{
    side_ = scalar(colour_);
    faces_ = scalar(colour_);
    bar({0, 2.55}, {6.5, 2.68}, brighter(colour_, 0.7));
    bar({0, 0.75}, {6.5, 1.0}, lot_.pick(stripe_colours()));
    const auto pitch = lot_.real(0.95, 1.2);
    for (double x = 0.25; x + pitch < 6.3; x += pitch) glass({x, 1.4}, {x + pitch - 0.1, 2.4});
    for (const double door : {2.6, 5.5})
    {
        bar({door, 0.4}, {door + 0.75, 2.45}, {35, 35, 38});
        glass({door + 0.06, 0.55}, {door + 0.36, 2.35});
        glass({door + 0.4, 0.55}, {door + 0.7, 2.35});
    }
    bar({0, 0.3}, {6.5, 0.5}, {45, 45, 48});
    bar({0, 1.0}, {0.12, 0.7}, {40, 35, 160});
    bar({6.4, 0.95}, {6.5, 0.75}, {215, 225, 228});
    ends(0, 6);
    cv::flip(side_, left_side_, 1);
}

cv::Mat paint_model(int model)
{
    cv::Mat picture(kModelPixels, kWidthPixels, CV_8UC3);
    LorryPainter painter(picture, static_cast<std::uint64_t>(800 + model));
    if (model < kModelsOfAKind)
        painter.delivery();
    else
        painter.bus();
    return picture;
}

/** Both sides of a part, and its faces. */
void add_part(TexturedMesh& mesh, const PlaceFrame& frame, const Part& part, int model)
{
    constexpr double kAll = 1.0 * kModels * kModelPixels;
    const auto side_top = model * kModelPixels / kAll;
    const auto faces_top = side_top + 2 * kSidePixels / kAll;
    const auto faces_bottom = faces_top + kFacePixels / kAll;
    const auto half = part.width / 2;
    const auto corner = [&](const cv::Point2d& point, double left)
    {
        const bool is_left = left > 0;
        const auto forth = point.x / kLorryLength;
        const auto down = (1 - point.y / kHeight + (is_left ? 1 : 0)) * kSidePixels / kAll;
        return Corner{frame.at(point.x - kLorryLength / 2, left, point.y),
                      {is_left ? 1 - forth : forth, side_top + down}};
    };
    cv::Point2d middle;
    for (const auto& point : part.outline)
        middle += point / static_cast<double>(part.outline.size());
    for (std::size_t i = 0; i < part.outline.size(); ++i)
    {
        const auto& a = part.outline[i];
        const auto& b = part.outline[(i + 1) % part.outline.size()];
        mesh.add_triangle(corner(middle, half), corner(a, half), corner(b, half));
        mesh.add_triangle(corner(middle, -half), corner(b, -half), corner(a, -half));
        if (i + 1 == part.outline.size()) break;
        const auto face = part.first_face + (part.all_one_face ? 0.0 : static_cast<double>(i));
        const auto left = (face + 0.02) / kFaces;
        const auto right = (face + 0.98) / kFaces;
        mesh.add_quad({corner(a, -half).at, {left, faces_bottom}},
                      {corner(b, -half).at, {right, faces_bottom}},
                      {corner(b, half).at, {right, faces_top}},
                      {corner(a, half).at, {left, faces_top}});
    }
}

/** What is seen of a tyre from behind. */
void add_tread(TexturedMesh& wheels, const PlaceFrame& frame, double ahead, double outer)
{
    constexpr double kTyre = 0.35;  // m
    const cv::Rect2d rubber(0.01, 0.0005, 0.02, 0.002);  // a corner of the picture
    const auto inner = outer > 0 ? outer - kTyre : outer + kTyre;
    add_limb(wheels,
             {{frame.at(ahead, inner, kWheelRadius), 0.97 * kWheelRadius},
              {frame.at(ahead, outer * 0.995, kWheelRadius), 0.97 * kWheelRadius}},
             rubber);
}
}  // namespace

cv::Mat paint_lorries()
{
    cv::Mat picture(kModels * kModelPixels, kWidthPixels, CV_8UC3);
    for (int model = 0; model < kModels; ++model)
        paint_model(model).copyTo(
            picture.rowRange(model * kModelPixels, (model + 1) * kModelPixels));
    Lot lot(74);
    add_stains(picture, 25 * kModels, 14, lot);
    shade(picture, fractal_noise(picture.size(), 60, lot), 0.06);
    add_grain(picture, 3, lot);
    return picture;
}

void add_lorry(TexturedMesh& bodies,
               TexturedMesh& wheels,
               const StandingObject& lorry,
               LorryKind kind)
{
    Lot lot(lorry.seed);
    const PlaceFrame frame(lorry, 0);
    const auto model =
        lot.whole(0, kModelsOfAKind - 1) + (kind == LorryKind::delivery ? 0 : kModelsOfAKind);
    for (const auto& part : parts_of(kind)) add_part(bodies, frame, part, model);
    const auto wheel = lot.whole(0, kWheelKinds - 1);
    for (const double axle : axles_of(kind))
        for (const double side : {-1.0, 1.0})
        {
            const auto ahead = axle - kLorryLength / 2;
            const auto outer = side * (kLorryWidth / 2 + 0.02);
            const auto angle = lot.real(0, 2 * CV_PI);
            add_wheel(wheels, frame, {ahead, outer, kWheelRadius}, wheel, angle);
            add_tread(wheels, frame, ahead, outer);
        }
}

}  // namespace fild
