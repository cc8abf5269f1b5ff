// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace fild
{
/** Red, green and blue, 0 to 255. */
using PlotColour = std::array<int, 3>;

/** A polyline. Value type. */
struct PlotLine
{
    std::vector<cv::Point2d> points;
    PlotColour colour{};
    double width = 1;
    double dash = 0;  ///< length of a dash, and half as much of a gap; 0: none
    double opacity = 1;
};

struct PlotDisc
{
    cv::Point2d centre;
    double radius = 1;
    PlotColour colour{};
};

struct PlotText
{
    enum class Anchor
    {
        start,
        middle,
        end
    };
    cv::Point2d at;  ///< on the line that the text stands on
    std::string text;
    Anchor anchor = Anchor::start;
    double size = 14;
    PlotColour colour{};
    bool upwards = false;
};

/** The text with what means something in XML escaped. */
std::string xml_escaped(const std::string& text);

/** A drawing of few kinds of things that can be written as SVG and as PNG. Lengths are pixels of
 *  the SVG. Not thread-safe: one caller at a time. */
class VectorPlot
{
 public:
    VectorPlot(cv::Size2d size, std::string title) : size_(size), title_(std::move(title)) {}

    /** Draws over what was added before. */
    void add(std::variant<PlotLine, PlotDisc, PlotText> thing)
    {
        things_.push_back(std::move(thing));
    }

    std::string svg() const;

    /** Content of a PNG file with twice as many pixels in either direction. Letters that are not
     *  ASCII are shown as question marks. */
    std::string png() const;

 private:
    cv::Size2d size_;
    std::string title_;
    std::vector<std::variant<PlotLine, PlotDisc, PlotText>> things_;
};

}  // namespace fild
