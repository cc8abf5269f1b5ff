// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_report.h"

#include "fild/core/whole_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

/** Three decimals; only what is perfect reads 1.000. */
std::string three_decimals(const std::optional<double>& share)
{
    if (!share) return "-";
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << (*share < 1 ? std::min(*share, 0.999) : 1.0);
    return text.str();
}

class AlignedLines
{
 public:
    void words(const std::string& name, const std::string& value)
    {
        text_ << std::left << std::setw(kNameWidth) << name << value << '\n';
    }

    template <class Value>
    void number(const std::string& name, const Value& value, const std::string& meaning)
    {
        text_ << std::left << std::setw(kNameWidth) << name << std::right << std::setw(6) << value
              << (meaning.empty() ? "" : "  ") << meaning << '\n';
    }

    std::string text() const { return text_.str(); }

 private:
    static constexpr int kNameWidth = 14;
    std::ostringstream text_;
};

std::string line_of(const WrongLoop& wrong)
{
    std::ostringstream line;
    line << "frame " << to_index(wrong.verdict.frame) << " at frame "
         << to_index(wrong.verdict.candidate->frame) << ", " << wrong.verdict.inliers << " inliers"
         << (wrong.loop_query ? ", has a loop elsewhere" : ", has no loop");
    return line.str();
}

Json or_null(const std::optional<double>& value)
{
    return value ? Json(*value) : Json();
}

Json protocol_json(const Protocol& protocol)
{
    Json json = {{"name", to_word(protocol)}, {"rule", rule_of(protocol)}};
    if (protocol.kind == Protocol::Kind::window) json["window_frames"] = protocol.window;
    if (protocol.kind == Protocol::Kind::radius)
    {
        json["radius_metres"] = protocol.radius;
        json["max_angle_deg"] = protocol.max_angle_deg;
        json["min_age_seconds"] = protocol.min_age_seconds;
    }
    return json;
}

void write_json(const EvaluationReport& report, const std::string& path)
{
    const auto& score = report.score;
    const Json json = {
        {"run", report.run},
        {"ground_truth",
         {{"file", report.ground_truth_file},
          {"content", report.ground_truth_content},
          {"remarks", report.remarks}}},
        {"protocol", protocol_json(report.protocol)},
        {"frames", score.frames},
        {"loop_queries", score.loop_queries},
        {"accepted", score.accepted},
        {"right", score.right},
        {"wrong", score.wrong_loops.size()},
        {"neither", score.neither},
        {"missed", score.missed()},
        {"precision", or_null(score.precision())},
        {"recall", or_null(score.recall())},
    };
    WholeFile file(path);
    file.stream() << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    file.commit();
}

void write_wrong_loops(const std::vector<WrongLoop>& wrong_loops, const std::string& path)
{
    WholeFile file(path);
    auto& out = file.stream();
    out << "frame,candidate,similarity,matches,inliers,loop_query\n"
        << std::fixed << std::setprecision(6);
    for (const auto& [verdict, loop_query] : wrong_loops)
        out << to_index(verdict.frame) << ',' << to_index(verdict.candidate->frame) << ','
            << verdict.candidate->similarity << ',' << verdict.matches << ',' << verdict.inliers
            << ',' << (loop_query ? 1 : 0) << '\n';
    file.commit();
}
}  // namespace

std::string to_text(const EvaluationReport& report, std::size_t max_wrong)
{
    const auto& score = report.score;
    const auto& wrong = score.wrong_loops;
    AlignedLines lines;
    lines.words("run", report.run + ", " + std::to_string(score.frames) + " frames");
    lines.words("ground truth", report.ground_truth_file + ": " + report.ground_truth_content);
    for (const auto& remark : report.remarks) lines.words("", remark);
    lines.words("protocol", to_word(report.protocol) + ": " + rule_of(report.protocol));
    lines.number("loop queries", score.loop_queries, "frames with a true loop");
    lines.number("accepted", score.accepted, "loop closures");
    lines.number("  right", score.right, "");
    lines.number("  wrong", wrong.size(), "");
    lines.number("  neither", score.neither, "left out of precision");
    lines.number("missed", score.missed(), "loop queries without a right answer");
    lines.number("precision", three_decimals(score.precision()), "right / (right + wrong)");
    lines.number("recall", three_decimals(score.recall()), "right / loop queries");
    for (std::size_t i = 0; i < std::min(wrong.size(), max_wrong); ++i)
        lines.words(i == 0 ? "wrong" : "", line_of(wrong[i]));
    if (wrong.size() > max_wrong)
        lines.words("", "and " + std::to_string(wrong.size() - max_wrong) + " more");
    return lines.text();
}

void write_report(const EvaluationReport& report, const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot make the output folder " + folder + ": " +
                                 error.message());
    const std::filesystem::path path(folder);
    write_wrong_loops(report.score.wrong_loops, (path / "wrong_loops.csv").string());
    write_json(report, (path / "evaluation.json").string());
}

}  // namespace fild
