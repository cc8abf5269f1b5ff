// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/html_report.h"

#include "run_folder.h"
#include "text_file.h"

#include <map>
#include <string_view>

namespace fild
{
// Files of html/ and of Apache ECharts, see CMakeLists.txt.
extern const std::string_view kReportHtml;
extern const std::string_view kReportCss;
extern const std::string_view kReportJs;
extern const std::string_view kChartsJs;
extern const std::string_view kChartsLicence;
extern const std::string_view kChartsNotice;

namespace
{
/** JSON that may stand in a script element: nothing in it ends the element. */
std::string for_script(const nlohmann::ordered_json& json)
{
    auto text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

/** The text with each `@NAME@` that is a key replaced. */
std::string filled_in(std::string_view text, const std::map<std::string, std::string>& values)
{
    std::string filled;
    while (!text.empty())
    {
        const auto begin = text.find('@');
        const auto end = begin == std::string_view::npos ? begin : text.find('@', begin + 1);
        if (end == std::string_view::npos) return filled.append(text);
        const auto value = values.find(std::string(text.substr(begin + 1, end - begin - 1)));
        if (value == values.end())
        {
            filled.append(text.substr(0, begin + 1));
            text.remove_prefix(begin + 1);
            continue;
        }
        filled.append(text.substr(0, begin)).append(value->second);
        text.remove_prefix(end + 1);
    }
    return filled;
}
}  // namespace

void write_html_report(const std::string& folder,
                       const TReportOptions& options,
                       const std::optional<ReportTruth>& truth)
{
    const auto run = read_run_folder(folder, options, truth);
    write_text_file(std::filesystem::path(folder) / "report.html",
                    filled_in(kReportHtml,
                              {{"STYLE", std::string(kReportCss)},
                               {"DATA", for_script(run)},
                               {"CHARTS", std::string(kChartsJs)},
                               {"LICENCE", std::string(kChartsLicence)},
                               {"NOTICE", std::string(kChartsNotice)},
                               {"SCRIPT", std::string(kReportJs)}}));
}

}  // namespace fild
