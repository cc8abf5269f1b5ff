// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_parts.h"

#include <locale>
#include <sstream>

namespace fild
{
namespace
{
/** With the characters that mean something to LaTeX written so that they do not. */
std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
    {
        if (std::string("_%&#$").find(c) != std::string::npos) out += '\\';
        out += c;
    }
    return out;
}

void write_row(std::ostream& tex, const std::vector<std::string>& cells)
{
    for (std::size_t i = 0; i < cells.size(); ++i) tex << (i == 0 ? "" : " & ") << cells[i];
    tex << " \\\\\n";
}
}  // namespace

std::string sweep_tex(const SweepReport& report)
{
    std::vector<std::string> head;
    for (const auto& key : report.keys) head.push_back("\\texttt{" + escaped(key) + "}");
    for (const auto& column : kSweepColumns) head.emplace_back(column.tex);
    for (const auto& column : kSweepTimes) head.emplace_back(column.tex);
    std::ostringstream tex;
    tex.imbue(std::locale::classic());
    tex << "% " << rule_of(report.truth.protocol) << "\n% \\usepackage{booktabs}\n\\begin{tabular}{"
        << std::string(head.size(), 'r') << "}\n\\toprule\n";
    write_row(tex, head);
    tex << "\\midrule\n";
    for (const auto& point : report.points)
    {
        auto cells = cells_of(point);
        for (auto& cell : cells) cell = cell == "-" ? "--" : escaped(cell);
        write_row(tex, cells);
    }
    tex << "\\bottomrule\n\\end{tabular}\n";
    return tex.str();
}

}  // namespace fild
