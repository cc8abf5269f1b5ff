// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/match_picture.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
constexpr int kGap = 8;  // pixels between the images
const cv::Scalar kBackground(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);

/** Where the two images lie in the picture. */
struct Layout
{
    cv::Rect query;
    cv::Rect candidate;
    int caption_top = 0;
    int caption_height = 0;
    cv::Size size;
};

Layout lay_out(const cv::Size& query, const cv::Size& candidate)
{
    Layout layout;
    layout.query = {cv::Point(0, 0), query};
    const bool wide = query.width > 2 * query.height;
    layout.candidate = {wide ? cv::Point(0, query.height + kGap) : cv::Point(query.width + kGap, 0),
                        candidate};
    const auto both = layout.query | layout.candidate;
    layout.caption_top = both.height;
    layout.caption_height = std::clamp(both.width / 22, 26, 64);
    layout.size = {both.width, both.height + layout.caption_height};
    return layout;
}

void paste(const cv::Mat& image, const cv::Rect& place, cv::Mat& canvas)
{
    if (image.channels() == 3)
        image.copyTo(canvas(place));
    else
        cv::cvtColor(image, canvas(place), cv::COLOR_GRAY2BGR);
}

/** One colour for each row of the query image, dark blue at the top to yellow at the bottom. */
cv::Mat colours_by_row(int rows)
{
    cv::Mat ramp(rows, 1, CV_8UC1);
    for (int y = 0; y < rows; ++y)
        ramp.at<unsigned char>(y) = static_cast<unsigned char>(255 * y / std::max(1, rows - 1));
    cv::Mat colours;
    cv::applyColorMap(ramp, colours, cv::COLORMAP_VIRIDIS);
    return colours;
}

cv::Point in_picture(const PixelPosition& pixel, const cv::Rect& image)
{
    return {image.x + cvRound(pixel.x), image.y + cvRound(pixel.y)};
}

void draw_matches(const std::vector<PixelPair>& inliers, const Layout& layout, cv::Mat& canvas)
{
    const auto colours = colours_by_row(layout.query.height);
    for (const auto& pair : inliers)
    {
        const int row = std::clamp(cvRound(pair.query.y), 0, layout.query.height - 1);
        const cv::Scalar colour(colours.at<cv::Vec3b>(row));
        const auto query = in_picture(pair.query, layout.query);
        const auto candidate = in_picture(pair.candidate, layout.candidate);
        cv::line(canvas, query, candidate, colour, 1, cv::LINE_AA);
        cv::circle(canvas, query, 3, colour, 1, cv::LINE_AA);
        cv::circle(canvas, candidate, 3, colour, 1, cv::LINE_AA);
    }
}

std::string caption_of(const MatchPicture& picture)
{
    const auto& verdict = picture.verdict;
    const double seconds = verdict.timestamp - picture.candidate_timestamp;
    std::array<char, 200> text{};
    const auto outcome =
        verdict.accepted() ? std::string("loop closure") : to_word(verdict.rejection);
    std::snprintf(
        text.data(),
        text.size(),
        "frame %llu and %llu, %.1f s %s | similarity %.3f | %zu matches, %zu inliers | %s",
        static_cast<unsigned long long>(to_index(verdict.frame)),
        static_cast<unsigned long long>(to_index(verdict.candidate->frame)),
        std::abs(seconds),
        seconds < 0 ? "later by its clock" : "earlier",
        verdict.candidate->similarity,
        verdict.matches,
        verdict.inliers,
        outcome.c_str());
    return text.data();
}

/** One line of text, as large as the strip allows. */
void draw_caption(const std::string& text, const Layout& layout, cv::Mat& canvas)
{
    const int font = cv::FONT_HERSHEY_SIMPLEX;
    int below = 0;
    const auto unit = cv::getTextSize(text, font, 1.0, 1, &below);
    const double scale =
        std::min(0.92 * layout.size.width / unit.width, 0.55 * layout.caption_height / unit.height);
    const int baseline =
        layout.caption_top + cvRound((layout.caption_height + scale * unit.height) / 2);
    cv::putText(canvas,
                text,
                {layout.caption_height / 3, baseline},
                font,
                scale,
                kInk,
                scale > 0.8 ? 2 : 1,
                cv::LINE_AA);
}
}  // namespace

cv::Mat draw_match_picture(const MatchPicture& picture)
{
    if (picture.query_image.empty() || picture.candidate_image.empty())
        throw std::invalid_argument("draw_match_picture: an image is empty");
    if (!picture.verdict.candidate)
        throw std::invalid_argument("draw_match_picture: the verdict names no candidate");
    const auto layout = lay_out(picture.query_image.size(), picture.candidate_image.size());
    cv::Mat canvas(layout.size, CV_8UC3, kBackground);
    paste(picture.query_image, layout.query, canvas);
    paste(picture.candidate_image, layout.candidate, canvas);
    draw_matches(picture.inliers, layout, canvas);
    draw_caption(caption_of(picture), layout, canvas);
    return canvas;
}

}  // namespace fild
