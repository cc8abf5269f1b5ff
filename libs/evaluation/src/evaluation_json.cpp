// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

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

Json value_json(const Metric& metric)
{
    if (!metric.value) return nullptr;
    if (metric.kind == Metric::Kind::count) return static_cast<std::int64_t>(*metric.value);
    return *metric.value;
}

Json worst_wrong_json(const std::optional<WorstWrongPair>& worst)
{
    if (!worst) return nullptr;
    return {{"frame", to_index(worst->frame)},
            {"candidate", to_index(worst->candidate)},
            {"inliers", worst->inliers},
            {"support", worst->support},
            {"accepted", worst->accepted}};
}

Json run_json(const RunEvaluation& run)
{
    Json json = {{"run", run.folder}, {"frames", run.score.frames}};
    for (const auto& metric : metrics_of(run)) json[metric.key] = value_json(metric);
    json["worst_wrong_pair"] = worst_wrong_json(run.worst_wrong);
    return json;
}

Json ranges_json(const EvaluationReport& report)
{
    Json json = Json::object();
    for (const auto& range : ranges_of(metrics_of_runs(report)))
    {
        auto& metric = json[range.metric.key];
        if (range.runs > 0)
            metric = {{"mean", *range.metric.value},
                      {"min", range.min},
                      {"max", range.max},
                      {"runs", range.runs}};
    }
    return json;
}
}  // namespace

std::string evaluation_json(const EvaluationReport& report)
{
    Json json = {
        {"ground_truth",
         {{"file", report.truth.file},
          {"content", report.truth.content},
          {"remarks", report.truth.remarks}}},
        {"protocol", protocol_json(report.truth.protocol)},
        {"remarks", report.run_remarks},
    };
    if (report.runs.size() == 1)
        json.update(run_json(report.runs.front()));
    else
    {
        json["metrics"] = ranges_json(report);
        json["runs"] = Json::array();
        for (const auto& run : report.runs) json["runs"].push_back(run_json(run));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace fild
