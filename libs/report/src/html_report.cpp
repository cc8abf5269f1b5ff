// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/html_report.h"

#include "comparison.h"
#include "data_url.h"
#include "fild/core/whole_file.h"
#include "page_frames.h"
#include "report_pictures.h"
#include "run_folder.h"

#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace fild
{
// Files of html/ and of Apache ECharts, see CMakeLists.txt.
extern const std::string_view kReportHtml;
extern const std::string_view kReportCss;
extern const std::string_view kReportJs;
extern const std::string_view kComparisonHtml;
extern const std::string_view kComparisonJs;
extern const std::string_view kCommonJs;
extern const std::string_view kChartsJs;
extern const std::string_view kChartsLicence;
extern const std::string_view kChartsNotice;

namespace
{
/** The text with what means something in HTML escaped. */
std::string for_html(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else
            safe += c;
    return safe;
}

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

/** Writes a page that needs nothing but itself. */
void write_page(std::string_view html,
                std::string_view script,
                const nlohmann::ordered_json& data,
                const std::filesystem::path& path)
{
    write_whole_file(path,
                     filled_in(html,
                               {{"STYLE", std::string(kReportCss)},
                                {"DATA", for_script(data)},
                                {"CHARTS", std::string(kChartsJs)},
                                {"LICENCE", for_html(kChartsLicence)},
                                {"NOTICE", for_html(kChartsNotice)},
                                {"COMMON", std::string(kCommonJs)},
                                {"SCRIPT", std::string(script)}}));
}
}  // namespace

namespace
{
/** Results in the folder that a reader may want to open. */
std::vector<std::string> files_beside(const std::string& folder)
{
    std::vector<std::string> there;
    for (const auto* name : {"frames.csv",
                             "loops.csv",
                             "candidates.csv",
                             "wrong_loops.csv",
                             "missed_loops.csv",
                             "costs.csv",
                             "summary.json",
                             "poses.csv",
                             "trajectory_optimized.tum",
                             "poses.graph",
                             "poses.g2o",
                             "map.simplemap",
                             "map.3Dscene",
                             "map_top.png",
                             "map_perspective.png"})
        if (std::filesystem::exists(std::filesystem::path(folder) / name)) there.emplace_back(name);
    return there;
}
}  // namespace

void write_html_report(const std::string& folder,
                       const TReportOptions& options,
                       const std::optional<ReportTruth>& truth)
{
    const auto run = read_run_folder(folder);
    std::set<FrameId> wrong;
    if (truth)
        for (const auto& loop : truth->evaluation.score.wrong_loops)
            wrong.insert(loop.verdict.frame);
    const auto pictured = frames_to_show(folder, run.frames, options, wrong);
    auto page = page_frames(run, truth);
    add_pairs(page, pictured);
    auto json = run_json(run, truth, page);
    add_pictures(json,
                 folder,
                 pictured,
                 static_cast<std::size_t>(options.max_pictures),
                 options.picture_width_px);
    json["map_pictures"] = map_pictures_json(folder);
    json["has_matches_beside"] = true;
    json["files"] = files_beside(folder);
    const auto similarity = folder + "/similarity.png";
    if (std::filesystem::exists(similarity)) json["similarity"] = data_url_of_png(similarity);
    write_page(kReportHtml, kReportJs, json, std::filesystem::path(folder) / "report.html");
}

void write_html_comparison(const ComparedRun& first,
                           const ComparedRun& second,
                           const TReportOptions& options,
                           const std::string& path)
{
    write_page(kComparisonHtml, kComparisonJs, comparison_json(first, second, options), path);
}

}  // namespace fild
