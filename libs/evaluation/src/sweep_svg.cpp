// SPDX-License-Identifier: BSD-3-Clause
#include "plot.h"
#include "sweep_parts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <locale>
#include <sstream>

namespace fild
{
namespace
{
// Pixels.
constexpr double kTop = 40;
constexpr double kLeft = 70;  ///< of a plot within its panel
constexpr double kPlotWidth = 280;
constexpr double kPlotHeight = 220;
constexpr double kPanelWidth = kLeft + kPlotWidth + 20;
constexpr double kLegendRow = 22;
constexpr double kLetter = 8;  ///< width, about

/** Colours of Okabe and Ito, which the colour-blind can tell apart. */
constexpr std::array<const char*, 7> kColours{
    {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"}};

/** A value with its range over the seeds, at the x-th value of the first key. */
struct Mark
{
    std::size_t x = 0;
    double value = 0;
    double min = 0;
    double max = 0;
};

/** What is drawn of a point, if it is defined. */
using Quantity = std::function<std::optional<Mark>(const SweepPoint&)>;

Quantity metric_named(const std::string& key)
{
    return [key](const SweepPoint& point) -> std::optional<Mark>
    {
        const auto range = find_metric(ranges_of(point), key);
        if (!range) return std::nullopt;
        return Mark{0, *range->metric.value, range->min, range->max};
    };
}

Quantity time_of(const std::string& stage)
{
    return [stage](const SweepPoint& point) -> std::optional<Mark>
    {
        const auto time = median_ms(point, stage);
        if (!time) return std::nullopt;
        return Mark{0, *time, *time, *time};
    };
}

struct Panel
{
    std::string title;
    std::vector<std::pair<Quantity, const char*>> quantities;  ///< with dashes
    bool of_shares = false;  ///< the axis goes from 0 to 1
};

std::vector<Panel> panels()
{
    return {{"recall (line), precision (dashes)",
             {{metric_named("recall"), "none"}, {metric_named("precision"), "6 4"}},
             true},
            {"search, ms", {{time_of("index_search"), "none"}}, false},
            {"matching a candidate, ms", {{time_of("matching"), "none"}}, false}};
}

/** Points that differ in the first key alone are one line. */
struct Series
{
    std::string name;
    std::vector<const SweepPoint*> points;
};

std::string name_of(const SweepReport& report, const SweepPoint& point)
{
    std::string name;
    for (std::size_t i = 1; i < report.keys.size(); ++i)
        name += (i == 1 ? "" : ", ") + report.keys[i] + " = " + point.values[i];
    return name;
}

std::vector<Series> series_of(const SweepReport& report)
{
    std::vector<Series> all;
    for (const auto& point : report.points)
    {
        const auto name = name_of(report, point);
        auto series = std::find_if(
            all.begin(), all.end(), [&](const Series& other) { return other.name == name; });
        if (series == all.end()) series = all.insert(series, {name, {}});
        series->points.push_back(&point);
    }
    return all;
}

/** The values of the first key, in the order of the sweep. */
std::vector<std::string> ticks_of(const SweepReport& report)
{
    if (report.keys.empty()) return {""};
    std::vector<std::string> ticks;
    for (const auto& point : report.points)
        if (std::find(ticks.begin(), ticks.end(), point.values.front()) == ticks.end())
            ticks.push_back(point.values.front());
    return ticks;
}

std::size_t longest_of(const std::vector<std::string>& texts)
{
    std::size_t longest = 0;
    for (const auto& text : texts) longest = std::max(longest, text.size());
    return longest;
}

/** Ticks that would run into each other are written upwards. */
bool are_upright(const std::vector<std::string>& ticks)
{
    return kLetter * static_cast<double>(longest_of(ticks) + 1) >
           kPlotWidth / static_cast<double>(ticks.size());
}

/** Height that ticks take, pixels. */
double height_of(const std::vector<std::string>& ticks)
{
    return are_upright(ticks) ? 12 + kLetter * static_cast<double>(longest_of(ticks)) : 26;
}

/** The least of 1, 2 and 5 times a power of ten that is not below. */
double round_up(double value)
{
    if (value <= 0) return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * power) return step * power;
    return 10 * power;
}

/** Draws one panel: where a mark stands is known here alone. */
class Plot
{
 public:
    Plot(std::ostream& svg, double left, std::vector<std::string> ticks, double top_value)
        : svg_(svg), left_(left + kLeft), ticks_(std::move(ticks)), top_value_(top_value)
    {
    }

    void axes(const std::string& title, const std::string& key)
    {
        text(left_ + kPlotWidth / 2, kTop - 14, "middle", title);
        for (int i = 0; i <= 5; ++i)
        {
            const double value = top_value_ * i / 5;
            svg_ << "<line x1='" << left_ << "' x2='" << left_ + kPlotWidth << "' y1='"
                 << y_of(value) << "' y2='" << y_of(value) << "' stroke='"
                 << (i == 0 ? "#000000" : "#dddddd") << "'/>\n";
            std::ostringstream number;
            number.imbue(std::locale::classic());
            number << value;
            text(left_ - 8, y_of(value) + 5, "end", number.str());
        }
        const double below = kTop + kPlotHeight;
        for (std::size_t i = 0; i < ticks_.size(); ++i)
            if (are_upright(ticks_))
                svg_ << "<text transform='translate(" << x_of(i) + 5 << ' ' << below + 8
                     << ") rotate(-90)' text-anchor='end'>" << xml_escaped(ticks_[i])
                     << "</text>\n";
            else
                text(x_of(i), below + 20, "middle", ticks_[i]);
        text(left_ + kPlotWidth / 2, below + height_of(ticks_) + 16, "middle", key);
    }

    std::size_t tick_of(const std::string& value) const
    {
        return static_cast<std::size_t>(std::find(ticks_.begin(), ticks_.end(), value) -
                                        ticks_.begin());
    }

    void line(const std::vector<Mark>& marks, const char* colour, const char* dashes)
    {
        svg_ << "<polyline fill='none' stroke-width='2.5' stroke='" << colour
             << "' stroke-dasharray='" << dashes << "' points='";
        for (const auto& mark : marks) svg_ << x_of(mark.x) << ',' << y_of(mark.value) << ' ';
        svg_ << "'/>\n";
        for (const auto& mark : marks)
            svg_ << "<line stroke-width='1.5' stroke='" << colour << "' x1='" << x_of(mark.x)
                 << "' x2='" << x_of(mark.x) << "' y1='" << y_of(mark.min) << "' y2='"
                 << y_of(mark.max) << "'/><circle r='4' fill='" << colour << "' cx='"
                 << x_of(mark.x) << "' cy='" << y_of(mark.value) << "'/>\n";
    }

 private:
    double x_of(std::size_t tick) const
    {
        return left_ +
               kPlotWidth * (static_cast<double>(tick) + 0.5) / static_cast<double>(ticks_.size());
    }

    double y_of(double value) const { return kTop + kPlotHeight * (1 - value / top_value_); }

    void text(double x, double y, const char* anchor, const std::string& words)
    {
        svg_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "'>"
             << xml_escaped(words) << "</text>\n";
    }

    std::ostream& svg_;
    double left_;
    std::vector<std::string> ticks_;
    double top_value_;
};

double top_value_of(const Panel& panel, const SweepReport& report)
{
    if (panel.of_shares) return 1;
    double top = 0;
    for (const auto& point : report.points)
        for (const auto& [quantity, dashes] : panel.quantities)
            if (const auto mark = quantity(point)) top = std::max(top, mark->max);
    return round_up(top);
}

void draw_panel(std::ostream& svg,
                double left,
                const Panel& panel,
                const SweepReport& report,
                const std::vector<Series>& all_series)
{
    Plot plot(svg, left, ticks_of(report), top_value_of(panel, report));
    plot.axes(panel.title, report.keys.empty() ? "" : report.keys.front());
    for (const auto& [quantity, dashes] : panel.quantities)
        for (std::size_t i = 0; i < all_series.size(); ++i)
        {
            std::vector<Mark> marks;
            for (const auto* point : all_series[i].points)
                if (auto mark = quantity(*point))
                {
                    mark->x = plot.tick_of(point->values.empty() ? "" : point->values.front());
                    marks.push_back(*mark);
                }
            plot.line(marks, kColours.at(i % kColours.size()), dashes);
        }
}

void draw_legend(std::ostream& svg, double top, const std::vector<Series>& all_series)
{
    for (std::size_t i = 0; i < all_series.size(); ++i)
    {
        const double y = top + kLegendRow * static_cast<double>(i);
        svg << "<line x1='" << kLeft << "' x2='" << kLeft + 30 << "' y1='" << y << "' y2='" << y
            << "' stroke-width='2.5' stroke='" << kColours.at(i % kColours.size())
            << "'/>\n<text x='" << kLeft + 38 << "' y='" << y + 5 << "'>"
            << xml_escaped(all_series[i].name) << "</text>\n";
    }
}
}  // namespace

std::string sweep_svg(const SweepReport& report)
{
    const auto all_series = series_of(report);
    const auto all_panels = panels();
    const bool needs_legend = report.keys.size() > 1;
    const double width = kPanelWidth * static_cast<double>(all_panels.size());
    const double legend_top = kTop + kPlotHeight + height_of(ticks_of(report)) + 49;
    const double height =
        legend_top + (needs_legend ? kLegendRow * static_cast<double>(all_series.size()) : 0);
    std::ostringstream svg;
    svg.imbue(std::locale::classic());
    svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height
        << "' viewBox='0 0 " << width << ' ' << height
        << "' font-family='sans-serif' font-size='14'>\n<title>Sweep</title>\n"
        << "<rect width='100%' height='100%' fill='#ffffff'/>\n";
    for (std::size_t i = 0; i < all_panels.size(); ++i)
        draw_panel(svg, kPanelWidth * static_cast<double>(i), all_panels[i], report, all_series);
    if (needs_legend) draw_legend(svg, legend_top, all_series);
    svg << "</svg>\n";
    return svg.str();
}

}  // namespace fild
