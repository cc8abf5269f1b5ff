// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"
#include "fild/core/words.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <sstream>

namespace fild
{
namespace
{
using Anchor = PlotText::Anchor;

// Pixels: the square of the plot, and the picture around it.
constexpr double kLeft = 70;
constexpr double kTop = 70;
constexpr double kSide = 360;
constexpr double kWidth = kLeft + kSide + 30;
constexpr double kHeight = kTop + kSide + 110;

constexpr PlotColour kGrey{0xDD, 0xDD, 0xDD};

/** How a curve is drawn; colours of Okabe and Ito, which the colour-blind can tell apart. */
struct CurveStyle
{
    ScoreKind kind;
    PlotColour colour;
    double dash;  ///< told apart in black and white too
    std::array<double, 2> label;  ///< of a threshold, from its point
    PlotText::Anchor anchor;
};
constexpr std::array<CurveStyle, 2> kStyles{
    {{ScoreKind::inliers, {0x00, 0x72, 0xB2}, 0, {{5, -6}}, Anchor::start},
     {ScoreKind::similarity, {0xD5, 0x5E, 0x00}, 7, {{-5, 14}}, Anchor::end}}};

double x_of(double recall)
{
    return kLeft + recall * kSide;
}

double y_of(double precision)
{
    return kTop + (1 - precision) * kSide;
}

std::string to_text(double number, int decimals)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::fixed << std::setprecision(decimals) << number;
    return text.str();
}

/** The end of a long text. */
std::string shortened(const std::string& text)
{
    constexpr std::size_t kLongest = 48;  // letters in a line
    return text.size() <= kLongest ? text : "..." + text.substr(text.size() - kLongest + 3);
}

void draw_title(VectorPlot& plot, const EvaluationReport& report)
{
    namespace fs = std::filesystem;
    const auto name = [](const std::string& path)
    {
        const auto whole = fs::path(path).lexically_normal();
        return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    };
    const auto& first = report.runs.front();
    const auto run = report.runs.size() > 1 ? std::to_string(report.runs.size()) + " runs"
                                            : shortened(name(first.folder));
    plot.add(PlotText{
        {x_of(0.5), 22}, run + ", " + count_of(first.score.frames, "frame"), Anchor::middle, 16});
    plot.add(PlotText{{x_of(0.5), 42},
                      "against " + shortened(name(report.truth.file)) + " (" +
                          to_word(report.truth.protocol) + ")",
                      Anchor::middle});
}

void draw_axes(VectorPlot& plot)
{
    for (int i = 0; i <= 5; ++i)
    {
        const double share = i / 5.0;
        const auto colour = i == 0 ? PlotColour{} : kGrey;
        plot.add(PlotLine{{{kLeft, y_of(share)}, {kLeft + kSide, y_of(share)}}, colour});
        plot.add(PlotLine{{{x_of(share), kTop}, {x_of(share), kTop + kSide}}, colour});
        plot.add(PlotText{{kLeft - 8, y_of(share) + 5}, to_text(share, 1), Anchor::end});
        plot.add(PlotText{{x_of(share), kTop + kSide + 20}, to_text(share, 1), Anchor::middle});
    }
    plot.add(PlotText{{x_of(0.5), kTop + kSide + 42}, "recall", Anchor::middle});
    plot.add(PlotText{{22, y_of(0.5)}, "precision", Anchor::middle, 14, {}, true});
}

bool has_curve(const PrecisionRecallCurve& curve)
{
    return curve.has_loop_queries && !curve.points.empty();
}

void draw_curve(VectorPlot& plot,
                const PrecisionRecallCurve& curve,
                const CurveStyle& style,
                double opacity)
{
    if (!has_curve(curve)) return;
    PlotLine line{
        {{x_of(0), y_of(curve.points.front().precision)}}, style.colour, 2.5, style.dash, opacity};
    for (const auto& point : curve.points)
        line.points.emplace_back(x_of(*point.recall), y_of(point.precision));
    plot.add(std::move(line));
}

/** Thresholds at some points of a curve, far enough from each other to be read. */
void draw_thresholds(VectorPlot& plot, const PrecisionRecallCurve& curve, const CurveStyle& style)
{
    constexpr double kApart = 50;
    if (!has_curve(curve)) return;
    cv::Point2d last(-kApart, 0);
    for (const auto& point : curve.points)
    {
        const cv::Point2d at(x_of(*point.recall), y_of(point.precision));
        if (std::max(std::abs(at.x - last.x), std::abs(at.y - last.y)) < kApart) continue;
        last = at;
        plot.add(PlotDisc{at, 2.5, style.colour});
        const int decimals = style.kind == ScoreKind::inliers ? 0 : 2;
        plot.add(PlotText{at + cv::Point2d(style.label[0], style.label[1]),
                          to_text(point.threshold, decimals),
                          style.anchor,
                          11,
                          style.colour});
    }
}

void draw_runs(VectorPlot& plot, const EvaluationReport& report)
{
    const double opacity = report.runs.size() > 1 ? 0.5 : 1;
    for (const auto& run : report.runs)
    {
        draw_curve(plot, run.inlier_curve, kStyles[0], opacity);
        draw_curve(plot, run.similarity_curve, kStyles[1], opacity);
    }
    if (report.runs.size() == 1)
    {
        draw_thresholds(plot, report.runs.front().inlier_curve, kStyles[0]);
        draw_thresholds(plot, report.runs.front().similarity_curve, kStyles[1]);
    }
    for (const auto& run : report.runs)
        if (const auto recall = run.score.recall(); recall && run.score.precision())
            plot.add(PlotDisc{{x_of(*recall), y_of(*run.score.precision())}, 5});
}

void draw_legend(VectorPlot& plot, const EvaluationReport& report)
{
    double y = kTop + kSide + 68;
    double x = kLeft;
    for (const auto& style : kStyles)
    {
        plot.add(PlotLine{{{x, y}, {x + 30, y}}, style.colour, 2.5, style.dash});
        plot.add(PlotText{{x + 38, y + 5}, std::string("by ") + to_word(style.kind)});
        x += 130;
    }
    y += 24;
    if (report.runs.size() == 1)
        plot.add(PlotText{{kLeft + kSide, y + 5}, "numbers: thresholds", Anchor::end, 11});
    plot.add(PlotDisc{{kLeft + 15, y}, 5});
    plot.add(PlotText{{kLeft + 38, y + 5},
                      report.runs.size() > 1 ? "the runs as they are" : "the run as it is"});
}
}  // namespace

VectorPlot precision_recall_plot(const EvaluationReport& report)
{
    VectorPlot plot({kWidth, kHeight}, "Precision and recall");
    draw_title(plot, report);
    draw_axes(plot);
    draw_runs(plot, report);
    if (!report.runs.front().score.recall())
        plot.add(PlotText{{x_of(0.5), y_of(0.5)}, "no loop query: no recall", Anchor::middle});
    draw_legend(plot, report);
    return plot;
}

}  // namespace fild
