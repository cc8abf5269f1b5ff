// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/match_picture.h"

#include "colour_scale.h"
#include "match_caption.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace fild
{
namespace
{
constexpr double kSmallImage = 500;  // pixels wide; only smaller ones are enlarged, to this
constexpr double kHeightShare = 0.7;  // both images together, of the picture's width
const cv::Scalar kRejectedColour(190, 190, 190);

/** Where the images lie, before captions. */
struct Arrangement
{
    bool is_stacked = false;
    double scale = 1;
    cv::Size query;
    cv::Size candidate;
};

/** \param size  of the box that both images must fit into. */
Arrangement arranged(const cv::Size& query,
                     const cv::Size& candidate,
                     int gap,
                     const cv::Size& size)
{
    const auto scale = [&](int width, int height, int gap_across)
    {
        return std::min(static_cast<double>(size.width - gap_across) / width,
                        static_cast<double>(size.height) / height);
    };
    const double beside =
        scale(query.width + candidate.width, std::max(query.height, candidate.height), gap);
    const double stacked =
        scale(std::max(query.width, candidate.width), query.height + candidate.height, 0);
    const double largest = std::max(1.0, kSmallImage / std::max(query.width, candidate.width));
    Arrangement arrangement;
    arrangement.is_stacked = std::min(stacked, largest) > std::min(beside, largest);
    arrangement.scale = std::min(std::max(stacked, beside), largest);
    const auto scaled = [&](const cv::Size& image)
    {
        return cv::Size(std::max(1, cvFloor(arrangement.scale * image.width)),
                        std::max(1, cvFloor(arrangement.scale * image.height)));
    };
    arrangement.query = scaled(query);
    arrangement.candidate = scaled(candidate);
    return arrangement;
}

/** The picture with its images and captions, and where pixels of the images lie in it. */
class Sheet
{
 public:
    Sheet(const MatchPicture& picture, const TRenderOptions& options);

    cv::Point2d place_in_query(const PixelPosition& pixel) const
    {
        return place(pixel, query_.image);
    }
    cv::Point2d place_in_candidate(const PixelPosition& pixel) const
    {
        return place(pixel, candidate_.image);
    }

    /** Where a pair stands along the side that the images share, 0 to 1. */
    double share(const PixelPair& pair) const;

    /** Titles and caption, over what is drawn. */
    void write_texts(const MatchPicture& picture, std::size_t lines);

    /** Of a length at a width of 1400, pixels, at least. */
    double scaled(double length, double least) const
    {
        return std::max(least, length * canvas_.cols / 1400);
    }

    cv::Mat& canvas() { return canvas_; }

 private:
    cv::Point2d place(const PixelPosition& pixel, const cv::Rect& image) const
    {
        const auto x = static_cast<double>(pixel.x) + 0.5;
        const auto y = static_cast<double>(pixel.y) + 0.5;
        return {image.x + scale_ * x - 0.5, image.y + scale_ * y - 0.5};
    }

    struct Side
    {
        cv::Rect image;
        std::vector<std::string> title;
    };

    void paste(const cv::Mat& image, const cv::Rect& place);
    void write_title(const Side& side);

    cv::Mat canvas_;
    bool is_stacked_ = false;
    double scale_ = 1;
    double letters_ = 14;
    Side query_;
    Side candidate_;
};

Sheet::Sheet(const MatchPicture& picture, const TRenderOptions& options)
{
    const int widest = options.match_picture_width_px;
    const int gap = std::max(4, widest / 175);
    const auto images = arranged(picture.query_image.size(),
                                 picture.candidate_image.size(),
                                 gap,
                                 {widest, cvRound(kHeightShare * widest)});
    is_stacked_ = images.is_stacked;
    scale_ = images.scale;
    letters_ = caption_height(widest);
    query_.title = wrapped(query_title(picture), letters_, images.query.width);
    candidate_.title = wrapped(candidate_title(picture), letters_, images.candidate.width);
    const int query_strip = strip_height(query_.title.size(), letters_);
    const int candidate_strip = strip_height(candidate_.title.size(), letters_);
    const int top = is_stacked_ ? query_strip : std::max(query_strip, candidate_strip);
    auto& query = query_.image;
    auto& candidate = candidate_.image;
    query = {cv::Point(0, top), images.query};
    candidate = {is_stacked_ ? cv::Point(0, query.br().y + candidate_strip)
                             : cv::Point(query.br().x + gap, top),
                 images.candidate};
    canvas_ = cv::Mat((query | candidate).br().y,
                      std::max(query.br().x, candidate.br().x),
                      CV_8UC3,
                      cv::Scalar::all(255));
    paste(picture.query_image, query);
    paste(picture.candidate_image, candidate);
}

double Sheet::share(const PixelPair& pair) const
{
    const auto& image = query_.image;
    const auto at = place_in_query(pair.query) - cv::Point2d(image.tl());
    return is_stacked_ ? at.x / image.width : at.y / image.height;
}

void Sheet::write_title(const Side& side)
{
    const auto& image = side.image;
    const int height = strip_height(side.title.size(), letters_);
    draw_strip(canvas_, {image.x, image.y - height, image.width, height}, side.title, letters_);
}

void Sheet::write_texts(const MatchPicture& picture, std::size_t lines)
{
    write_title(query_);
    write_title(candidate_);
    const auto text = wrapped(match_caption(picture, lines), letters_, canvas_.cols);
    const cv::Rect strip(0, canvas_.rows, canvas_.cols, strip_height(text.size(), letters_));
    cv::copyMakeBorder(
        canvas_, canvas_, 0, strip.height, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(255));
    draw_strip(canvas_, strip, text, letters_);
}

void Sheet::paste(const cv::Mat& image, const cv::Rect& place)
{
    cv::Mat scaled_image;
    cv::resize(
        image, scaled_image, place.size(), 0, 0, scale_ < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    if (scaled_image.channels() == 1) cv::cvtColor(scaled_image, scaled_image, cv::COLOR_GRAY2BGR);
    scaled_image.copyTo(canvas_(place));
}

/** Points far outside would overflow OpenCV's fixed-point coordinates. */
cv::Point fixed_point(const cv::Point2d& point, int shift)
{
    constexpr double kFarthest = 20000;
    const double unit = 1 << shift;
    return {cvRound(unit * std::clamp(point.x, -kFarthest, kFarthest)),
            cvRound(unit * std::clamp(point.y, -kFarthest, kFarthest))};
}

/** Draws pairs in one colour each: lines that let the images shine through, then all the marks. */
class PairDrawing
{
 public:
    explicit PairDrawing(Sheet& sheet) : sheet_(sheet) {}

    template <class Colour>
    void draw_lines(const std::vector<PixelPair>& pairs,
                    const std::vector<std::size_t>& chosen,
                    double opacity,
                    const Colour& colour_of)
    {
        auto& canvas = sheet_.canvas();
        cv::Mat lines = canvas.clone();
        const int width = cvRound(sheet_.scaled(1, 1));
        for (const auto i : chosen)
            cv::line(lines,
                     fixed_point(sheet_.place_in_query(pairs[i].query), kShift),
                     fixed_point(sheet_.place_in_candidate(pairs[i].candidate), kShift),
                     colour_of(pairs[i]),
                     width,
                     cv::LINE_AA,
                     kShift);
        cv::addWeighted(lines, opacity, canvas, 1 - opacity, 0, canvas);
    }

    template <class Colour>
    void draw_marks(const std::vector<PixelPair>& pairs, double radius, const Colour& colour_of)
    {
        const double inner = sheet_.scaled(radius, 1.6);
        for (const auto& pair : pairs)
            for (const auto& at :
                 {sheet_.place_in_query(pair.query), sheet_.place_in_candidate(pair.candidate)})
            {
                draw_disc(at, inner + 1, {30, 30, 30});
                draw_disc(at, inner, colour_of(pair));
            }
    }

 private:
    static constexpr int kShift = 4;

    void draw_disc(const cv::Point2d& at, double radius, const cv::Scalar& colour)
    {
        cv::circle(sheet_.canvas(),
                   fixed_point(at, kShift),
                   cvRound(radius * (1 << kShift)),
                   colour,
                   cv::FILLED,
                   cv::LINE_AA,
                   kShift);
    }

    Sheet& sheet_;
};
}  // namespace

cv::Mat draw_match_picture(const MatchPicture& picture, const TRenderOptions& options)
{
    check_match_picture(picture);
    Sheet sheet(picture, options);
    PairDrawing drawing(sheet);
    const auto most = static_cast<std::size_t>(options.max_match_lines);
    if (!picture.rejected.empty())
    {
        const auto grey = [](const PixelPair&) { return kRejectedColour; };
        drawing.draw_lines(picture.rejected, spread_pairs(picture.rejected, most), 0.4, grey);
        drawing.draw_marks(picture.rejected, 1.6, grey);
    }
    const auto colour_of = [&](const PixelPair& pair)
    { return colour_on_scale(sheet.share(pair)); };
    const auto chosen = spread_pairs(picture.inliers, most);
    drawing.draw_lines(picture.inliers, chosen, 0.75, colour_of);
    drawing.draw_marks(picture.inliers, 2.4, colour_of);
    sheet.write_texts(picture, chosen.size());
    return sheet.canvas();
}

}  // namespace fild
