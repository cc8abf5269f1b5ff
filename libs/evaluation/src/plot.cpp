// SPDX-License-Identifier: BSD-3-Clause
#include "plot.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace fild
{
std::string xml_escaped(const std::string& text)
{
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return safe;
}

namespace
{
/** "#0072B2" */
std::string hexadecimal(const PlotColour& colour)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << '#' << std::hex << std::uppercase << std::setfill('0');
    for (const int part : colour) text << std::setw(2) << part;
    return text.str();
}

/** Writes things as elements of an SVG. */
struct SvgWriter
{
    std::ostream& svg;

    void operator()(const PlotLine& line) const
    {
        svg << "<polyline fill='none' stroke='" << hexadecimal(line.colour) << "' stroke-width='"
            << line.width << "' opacity='" << line.opacity << "' stroke-linejoin='round'";
        if (line.dash > 0) svg << " stroke-dasharray='" << line.dash << ' ' << line.dash / 2 << "'";
        svg << " points='";
        for (std::size_t i = 0; i < line.points.size(); ++i)
            svg << (i == 0 ? "" : " ") << line.points[i].x << ',' << line.points[i].y;
        svg << "'/>\n";
    }

    void operator()(const PlotDisc& disc) const
    {
        svg << "<circle cx='" << disc.centre.x << "' cy='" << disc.centre.y << "' r='"
            << disc.radius << "' fill='" << hexadecimal(disc.colour) << "' stroke='#FFFFFF'/>\n";
    }

    void operator()(const PlotText& text) const
    {
        constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
        svg << "<text transform='translate(" << text.at.x << ' ' << text.at.y << ")"
            << (text.upwards ? " rotate(-90)" : "") << "' text-anchor='"
            << kAnchors.at(static_cast<std::size_t>(text.anchor)) << "' font-size='" << text.size
            << "' fill='" << hexadecimal(text.colour) << "'>" << xml_escaped(text.text)
            << "</text>\n";
    }
};

constexpr int kPngScale = 2;

cv::Scalar bgr(const PlotColour& colour)
{
    return {static_cast<double>(colour[2]),
            static_cast<double>(colour[1]),
            static_cast<double>(colour[0])};
}

cv::Point on_png(const cv::Point2d& at)
{
    return {cvRound(kPngScale * at.x), cvRound(kPngScale * at.y)};
}

/** The parts of a polyline that its dashes cover, each with two ends. */
std::vector<std::array<cv::Point2d, 2>> dashes_of(const PlotLine& line)
{
    std::vector<std::array<cv::Point2d, 2>> dashes;
    double way = 0;  // along the polyline
    for (std::size_t i = 1; i < line.points.size(); ++i)
    {
        const auto& from = line.points[i - 1];
        const auto step = line.points[i] - from;
        const double length = cv::norm(step);
        const double period = line.dash > 0 ? 1.5 * line.dash : length;
        const double shown = line.dash > 0 ? line.dash : length;
        for (double at = line.dash > 0 ? -std::fmod(way, period) : 0; at < length; at += period)
        {
            const double begin = std::max(0.0, at);
            const double end = std::min(length, at + shown);
            if (begin < end)
                dashes.push_back({from + begin / length * step, from + end / length * step});
        }
        way += length;
    }
    return dashes;
}

/** Draws things into a picture. */
struct PngPainter
{
    cv::Mat& picture;

    void operator()(const PlotLine& line) const
    {
        cv::Mat drawn = picture.clone();
        for (const auto& [from, to] : dashes_of(line))
            cv::line(drawn,
                     on_png(from),
                     on_png(to),
                     bgr(line.colour),
                     cvRound(kPngScale * line.width),
                     cv::LINE_AA);
        cv::addWeighted(drawn, line.opacity, picture, 1 - line.opacity, 0, picture);
    }

    void operator()(const PlotDisc& disc) const
    {
        const auto centre = on_png(disc.centre);
        const int radius = cvRound(kPngScale * disc.radius);
        const cv::Scalar white(255, 255, 255);
        cv::circle(picture, centre, radius + 1, white, cv::FILLED, cv::LINE_AA);
        cv::circle(picture, centre, radius, bgr(disc.colour), cv::FILLED, cv::LINE_AA);
    }

    void operator()(const PlotText& text) const
    {
        constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
        constexpr double kHeightAtScaleOne = 30;  // of the font's lines
        const double scale = kPngScale * text.size / kHeightAtScaleOne;
        const int thickness = text.size < 12 ? 1 : 2;
        int below = 0;
        const auto size = cv::getTextSize(text.text, kFont, scale, thickness, &below);
        const double share = 0.5 * static_cast<double>(text.anchor);
        const cv::Point start(-cvRound(share * size.width), 0);
        if (!text.upwards)
            return cv::putText(picture,
                               text.text,
                               on_png(text.at) + start,
                               kFont,
                               scale,
                               bgr(text.colour),
                               thickness,
                               cv::LINE_AA);
        cv::Mat turned;
        cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
        const auto at = on_png(text.at);
        cv::putText(turned,
                    text.text,
                    cv::Point(picture.rows - 1 - at.y, at.x) + start,
                    kFont,
                    scale,
                    bgr(text.colour),
                    thickness,
                    cv::LINE_AA);
        cv::rotate(turned, picture, cv::ROTATE_90_COUNTERCLOCKWISE);
    }
};
}  // namespace

std::string VectorPlot::svg() const
{
    std::ostringstream svg;
    svg.imbue(std::locale::classic());
    svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << size_.width << "' height='"
        << size_.height << "' viewBox='0 0 " << size_.width << ' ' << size_.height
        << "' font-family='sans-serif' font-size='14'>\n<title>" << xml_escaped(title_)
        << "</title>\n<rect width='100%' height='100%' fill='#ffffff'/>\n";
    for (const auto& thing : things_) std::visit(SvgWriter{svg}, thing);
    svg << "</svg>\n";
    return svg.str();
}

std::string VectorPlot::png() const
{
    cv::Mat picture(on_png({size_.width, size_.height}).y,
                    on_png({size_.width, size_.height}).x,
                    CV_8UC3,
                    cv::Scalar(255, 255, 255));
    for (const auto& thing : things_) std::visit(PngPainter{picture}, thing);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", picture, bytes);
    return {bytes.begin(), bytes.end()};
}

}  // namespace fild
