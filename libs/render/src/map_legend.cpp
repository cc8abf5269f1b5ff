// SPDX-License-Identifier: BSD-3-Clause
#include "map_legend.h"

#include "colour_scale.h"
#include "fild/core/words.h"
#include "map_objects.h"
#include "picture_text.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fild
{
namespace
{
/** A number with as few digits as tell it. */
std::string to_text(double number)
{
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.7g", number + 0.0);  // no -0
    return text.data();
}

std::string in_metres(double length)
{
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), length < 100 ? "%.1f m" : "%.0f m", length);
    return text.data();
}

double length_of(const std::vector<std::vector<cv::Vec3d>>& ways)
{
    double length = 0;
    for (const auto& way : ways)
        for (std::size_t i = 1; i < way.size(); ++i) length += cv::norm(way[i] - way[i - 1]);
    return length;
}

/** The legend, line after line downwards. */
class Legend
{
 public:
    Legend(cv::Mat& picture, const MapContent& map)
        : picture_(picture),
          unit_(map.unit()),
          left_(map.plot().width + 22 * unit_),
          right_(picture.cols - 20 * unit_),
          y_(44 * unit_)
    {
    }

    void add_title(const std::string& text)
    {
        draw_text(picture_, text, {left_, y_}, {fitting(text, 19, left_), kInk, {0, 1}});
        y_ += 46 * unit_;
    }

    /** A sample of the line, and its name. */
    void add_line(const MapStyle& style, const std::string& name)
    {
        const double middle = y_ - 7 * unit_;
        cv::line(picture_,
                 cv::Point2d(left_, middle),
                 cv::Point2d(left_ + kSample * unit_, middle),
                 style.colour,
                 std::max(1, cvRound(style.width_px * unit_)),
                 cv::LINE_AA);
        add_name(name);
    }

    void add_mark(bool is_round, const cv::Scalar& colour, const std::string& name)
    {
        const cv::Point centre(cvRound(left_ + kSample * unit_ / 2), cvRound(y_ - 7 * unit_));
        const int radius = cvRound(8 * unit_);
        if (is_round)
            cv::circle(picture_, centre, radius, colour, cv::FILLED, cv::LINE_AA);
        else
            cv::rectangle(picture_,
                          centre - cv::Point(radius, radius),
                          centre + cv::Point(radius, radius),
                          colour,
                          cv::FILLED);
        add_name(name);
    }

    void add_ring(const cv::Scalar& colour, const std::string& name)
    {
        const cv::Point centre(cvRound(left_ + kSample * unit_ / 2), cvRound(y_ - 7 * unit_));
        cv::circle(picture_,
                   centre,
                   cvRound(7 * unit_),
                   colour,
                   std::max(1, cvRound(2.5 * unit_)),
                   cv::LINE_AA);
        add_name(name);
    }

    /** The colour scale under its title, with its first and last value. */
    void add_scale(const std::string& title, const std::array<double, 2>& range)
    {
        add_text(title);
        const cv::Rect bar(cv::Point2d(left_, y_ - 14 * unit_),
                           cv::Point2d(right_, y_ + 4 * unit_));
        for (int x = 0; x < bar.width; ++x)
            picture_(cv::Rect(bar.x + x, bar.y, 1, bar.height)) =
                colour_on_scale(static_cast<double>(x) / bar.width);
        y_ += 26 * unit_;
        const TextStyle small{kText * unit_, kInk, {0, 1}};
        draw_text(picture_, to_text(range[0]), {left_, y_}, small);
        draw_text(picture_, to_text(range[1]), {right_, y_}, {kText * unit_, kInk, {1, 1}});
        y_ += kLine * unit_;
    }

    void add_text(const std::string& text)
    {
        draw_text(picture_, text, {left_, y_}, {fitting(text, kText, left_), kInk, {0, 1}});
        y_ += kLine * unit_;
    }

    void add_gap() { y_ += 18 * unit_; }

 private:
    static constexpr double kSample = 34;
    static constexpr double kText = 14;
    static constexpr double kLine = 31;
    inline static const cv::Scalar kInk{50, 45, 40};

    void add_name(const std::string& name)
    {
        const double x = left_ + (kSample + 14) * unit_;
        draw_text(picture_, name, {x, y_}, {fitting(name, kText, x), kInk, {0, 1}});
        y_ += kLine * unit_;
    }

    /** A height at which the text does not reach beyond the legend, pixels. */
    double fitting(const std::string& text, double height, double left) const
    {
        const double wanted = height * unit_;
        const int width = text_size(text, {wanted}).width;
        return std::min(wanted, wanted * (right_ - left) / width);
    }

    cv::Mat& picture_;
    double unit_;
    double left_;
    double right_;
    double y_;  ///< the line that the next text stands on
};

/** The loops by what the ground truth says of them. */
void add_judgements(Legend& legend, const MapContent& map)
{
    for (const auto& [truth, name] : {std::pair{LoopTruthMark::right, "right loop"},
                                      std::pair{LoopTruthMark::wrong, "wrong loop"},
                                      std::pair{LoopTruthMark::doubtful, "doubtful loop"}})
        if (const auto count = map.count_loops(truth); count > 0)
            legend.add_mark(true, colour_of(truth), count_of(count, name));
    if (!map.missed.empty())
        legend.add_ring(kMissedStyle.colour, count_of(map.missed.size(), "missed loop"));
    legend.add_gap();
}

/** What stands below the samples: numbers of the map. */
void add_facts(Legend& legend, const MapContent& map)
{
    for (const auto& text : lengths_of(map)) legend.add_text(text);
    const double low = map.grid.height + map.shift[2];
    const double high = low + map.grid.climb;
    const auto in_decimetres = [](double z) { return to_text(std::round(10 * z) / 10); };
    legend.add_text("z = " + in_decimetres(low) +
                    (high - low < 0.05 ? " m" : " to " + in_decimetres(high) + " m"));
    legend.add_text("grid of " + to_text(map.grid.step) + " m");
    for (int i = 0; i < 2; ++i)
        if (map.shift[i] != 0)
            legend.add_text(std::string("add ") + to_text(map.shift[i]) + " m to " + "xy"[i]);
}

/** Lines of the grid that stand side by side, and what is written at their ends. */
struct Axis
{
    std::vector<std::pair<cv::Vec3d, cv::Vec3d>> lines;
    std::vector<std::string> labels;
};

/** \param is_x  the lines that each have one x; else one y. The last label names the axis. */
Axis axis_of(const GroundGrid& grid, bool is_x)
{
    Axis axis;
    const auto& area = grid.area;
    for (const double at : is_x ? grid.lines_of_x() : grid.lines_of_y())
    {
        axis.labels.push_back(to_text(at));
        if (is_x)
            axis.lines.push_back({{at, area.y, grid.height}, {at, area.br().y, grid.height}});
        else
            axis.lines.push_back({{area.x, at, grid.height}, {area.br().x, at, grid.height}});
    }
    axis.labels.back() = is_x ? "x [m]" : "y [m]";
    return axis;
}

TextStyle label_style(const MapContent& map)
{
    return {12.5 * map.unit(), {105, 95, 90}};
}

/** Writes the labels at the lower or left ends of the lines; of those that would touch the one
 *  before, none. */
void label(cv::Mat& picture, const MapContent& map, const PictureView& view, Axis axis)
{
    const auto& [first, second] = axis.lines[axis.lines.size() / 2];
    const auto across = view.project(second) - view.project(first);
    if (across.y - across.x > 0)
        for (auto& line : axis.lines) std::swap(line.first, line.second);
    cv::Rect last;
    for (std::size_t i = axis.lines.size(); i-- > 0;)
    {
        const auto end = view.project(axis.lines[i].first);
        const auto outwards =
            cv::Point2d(cv::normalize(cv::Vec2d(end - view.project(axis.lines[i].second))));
        auto style = label_style(map);
        style.anchor = {(1 - outwards.x) / 2, (1 - outwards.y) / 2};
        const auto at = end + 8 * map.unit() * outwards;
        const auto size = text_size(axis.labels[i], style) + cv::Size(cvRound(12 * map.unit()), 4);
        const cv::Rect place(cv::Point(at) - cv::Point(cvRound(style.anchor.x * size.width),
                                                       cvRound(style.anchor.y * size.height)),
                             size);
        if ((place & last).area() > 0) continue;
        draw_text(picture, axis.labels[i], at, style);
        last = place;
    }
}
}  // namespace

std::vector<std::string> lengths_of(const MapContent& map)
{
    std::size_t frames = 0;
    for (const auto& way : map.optimized) frames += way.size();
    std::vector<std::string> texts{count_of(frames, "frame"),
                                   "path of " + in_metres(length_of(map.optimized))};
    if (!map.ground_truth.empty())
        texts.push_back("true path of " + in_metres(length_of({map.ground_truth})));
    return texts;
}

void draw_legend(cv::Mat& picture, const MapContent& map, const std::string& title)
{
    Legend legend(picture, map);
    legend.add_title(title);
    legend.add_line(kOptimizedStyle, "optimised path");
    if (!map.input.empty()) legend.add_line(kInputStyle, "before the loops");
    if (!map.ground_truth.empty()) legend.add_line(map.truth_style(), "ground truth");
    if (!map.cameras.empty()) legend.add_line(kCameraStyle, "camera");
    if (!map.rejected.empty())
        legend.add_line(kRejectedStyle, count_of(map.rejected.size(), "rejected pair"));
    if (!map.unused_loops.empty())
        legend.add_line(kUnusedStyle, count_of(map.unused_loops.size(), "loop") + " not used");
    legend.add_mark(true, kStartColour, "start");
    legend.add_mark(false, kEndColour, "end");
    legend.add_gap();
    if (map.is_judged())
        add_judgements(legend, map);
    else if (!map.loops.empty())
    {
        const bool by_inliers = map.loop_colour == LoopColour::inliers;
        legend.add_scale(
            count_of(map.loops.size(), "loop") + (by_inliers ? ", inliers" : ", weight"),
            map.colour_range);
        legend.add_gap();
    }
    else
        legend.add_text("no loop in the map");
    add_facts(legend, map);
}

cv::Size label_size(const MapContent& map)
{
    cv::Size largest;
    for (const bool is_x : {true, false})
        for (const auto& text : axis_of(map.grid, is_x).labels)
        {
            const auto size = text_size(text, label_style(map));
            largest = {std::max(largest.width, size.width), std::max(largest.height, size.height)};
        }
    return largest + cv::Size(1, 1) * cvRound(16 * map.unit());
}

void draw_labels(cv::Mat& picture, const MapContent& map, const PictureView& view)
{
    for (const bool is_x : {true, false}) label(picture, map, view, axis_of(map.grid, is_x));
    const cv::Point2d aside(14 * map.unit(), 0);
    draw_text(picture,
              "start",
              view.project(start_mark(map)) - aside,
              {15 * map.unit(), kStartColour, {1, 1}, true});
    draw_text(picture,
              "end",
              view.project(end_mark(map)) + aside,
              {15 * map.unit(), kEndColour, {0, 0}, true});
}

}  // namespace fild
