// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"

#include <array>
#include <iomanip>
#include <locale>
#include <sstream>

namespace fild
{
namespace
{
// Pixels: the square of the plot, and the picture around it.
constexpr double kLeft = 70;
constexpr double kTop = 30;
constexpr double kSide = 360;
constexpr double kWidth = kLeft + kSide + 30;
constexpr double kHeight = kTop + kSide + 110;

/** How a curve is drawn; colours of Okabe and Ito, which the colour-blind can tell apart. */
struct CurveStyle
{
    ScoreKind kind;
    const char* colour;
    const char* dashes;  ///< told apart in black and white too
};
constexpr std::array<CurveStyle, 2> kStyles{
    {{ScoreKind::inliers, "#0072B2", "none"}, {ScoreKind::similarity, "#D55E00", "7 4"}}};

double x_of(double recall)
{
    return kLeft + recall * kSide;
}

double y_of(double precision)
{
    return kTop + (1 - precision) * kSide;
}

void draw_axes(std::ostream& svg)
{
    for (int i = 0; i <= 5; ++i)
    {
        const double share = i / 5.0;
        const char* const colour = i == 0 ? "#000000" : "#dddddd";
        svg << "<line x1='" << kLeft << "' x2='" << kLeft + kSide << "' y1='" << y_of(share)
            << "' y2='" << y_of(share) << "' stroke='" << colour << "'/>\n"
            << "<line y1='" << kTop << "' y2='" << kTop + kSide << "' x1='" << x_of(share)
            << "' x2='" << x_of(share) << "' stroke='" << colour << "'/>\n"
            << "<text x='" << kLeft - 8 << "' y='" << y_of(share) + 5 << "' text-anchor='end'>"
            << share << "</text>\n"
            << "<text x='" << x_of(share) << "' y='" << kTop + kSide + 20
            << "' text-anchor='middle'>" << share << "</text>\n";
    }
    svg << "<text x='" << x_of(0.5) << "' y='" << kTop + kSide + 42
        << "' text-anchor='middle'>recall</text>\n"
        << "<text transform='translate(22 " << y_of(0.5)
        << ") rotate(-90)' text-anchor='middle'>precision</text>\n";
}

void draw_curve(std::ostream& svg,
                const PrecisionRecallCurve& curve,
                const CurveStyle& style,
                double opacity)
{
    if (!curve.has_loop_queries || curve.points.empty()) return;
    svg << "<polyline fill='none' stroke='" << style.colour << "' stroke-width='2.5' opacity='"
        << opacity << "' stroke-dasharray='" << style.dashes << "' stroke-linejoin='round' points='"
        << x_of(0) << ',' << y_of(curve.points.front().precision);
    for (const auto& point : curve.points)
        svg << ' ' << x_of(*point.recall) << ',' << y_of(point.precision);
    svg << "'/>\n";
}

void draw_runs(std::ostream& svg, const EvaluationReport& report)
{
    const double opacity = report.runs.size() > 1 ? 0.5 : 1;
    for (const auto& run : report.runs)
    {
        draw_curve(svg, run.inlier_curve, kStyles[0], opacity);
        draw_curve(svg, run.similarity_curve, kStyles[1], opacity);
    }
    for (const auto& run : report.runs)
        if (const auto recall = run.score.recall(); recall && run.score.precision())
            svg << "<circle cx='" << x_of(*recall) << "' cy='" << y_of(*run.score.precision())
                << "' r='5' fill='#000000' stroke='#ffffff'/>\n";
}

void draw_legend(std::ostream& svg, const EvaluationReport& report)
{
    double y = kTop + kSide + 68;
    double x = kLeft;
    for (const auto& style : kStyles)
    {
        svg << "<line x1='" << x << "' x2='" << x + 30 << "' y1='" << y << "' y2='" << y
            << "' stroke-width='2.5' stroke='" << style.colour << "' stroke-dasharray='"
            << style.dashes << "'/>\n<text x='" << x + 38 << "' y='" << y + 5 << "'>by "
            << to_word(style.kind) << "</text>\n";
        x += 130;
    }
    y += 24;
    svg << "<circle cx='" << kLeft + 15 << "' cy='" << y << "' r='5'/>\n<text x='" << kLeft + 38
        << "' y='" << y + 5 << "'>"
        << (report.runs.size() > 1 ? "the runs as they are" : "the run as it is") << " ("
        << to_word(report.truth.protocol) << ")</text>\n";
}
}  // namespace

std::string precision_recall_svg(const EvaluationReport& report)
{
    std::ostringstream svg;
    svg.imbue(std::locale::classic());
    svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kWidth << "' height='" << kHeight
        << "' viewBox='0 0 " << kWidth << ' ' << kHeight
        << "' font-family='sans-serif' font-size='14'>\n<title>Precision and recall</title>\n"
        << "<rect width='100%' height='100%' fill='#ffffff'/>\n";
    draw_axes(svg);
    draw_runs(svg, report);
    if (!report.runs.front().score.recall())
        svg << "<text x='" << x_of(0.5) << "' y='" << y_of(0.5)
            << "' text-anchor='middle'>no loop query: no recall</text>\n";
    draw_legend(svg, report);
    svg << "</svg>\n";
    return svg.str();
}

}  // namespace fild
