// SPDX-License-Identifier: BSD-3-Clause
#include "loop_edges.h"

#include "csv_table.h"
#include "fild/core/angle.h"
#include "fild/core/words.h"
#include "rounded.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

cv::Matx33d rotation_about(int axis, double angle)
{
    cv::Matx33d rotation = cv::Matx33d::eye();
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    rotation(next, next) = rotation(last, last) = std::cos(angle);
    rotation(last, next) = std::sin(angle);
    rotation(next, last) = -std::sin(angle);
    return rotation;
}

/** Three columns of a row, if all are filled. */
std::optional<cv::Vec3d> vector_of(const CsvTable& table,
                                   std::size_t row,
                                   const std::array<const char*, 3>& columns)
{
    cv::Vec3d vector;
    for (int i = 0; i < 3; ++i)
    {
        const auto value = table.number(row, columns.at(static_cast<std::size_t>(i)));
        if (!value) return std::nullopt;
        vector[i] = *value;
    }
    return vector;
}

/** candidate_from_query of a row of loops.csv. */
std::optional<FramePose> edge_of(const CsvTable& table, std::size_t row)
{
    const auto position = vector_of(table, row, {"x", "y", "z"});
    const auto angles = vector_of(table, row, {"yaw_deg", "pitch_deg", "roll_deg"});
    if (!position || !angles) return std::nullopt;
    const auto radians = *angles * kRadiansPerDegree;
    return FramePose{rotation_about(2, radians[0]) * rotation_about(1, radians[1]) *
                         rotation_about(0, radians[2]),
                     *position};
}

/** The two poses of a loop on one trajectory. */
struct PosePair
{
    FramePose query;
    FramePose candidate;
};

std::optional<PosePair> poses_of(const FrameVerdict& loop,
                                 const std::string& name,
                                 const std::map<std::string, PosesOfFrames>& trajectories)
{
    const auto poses = trajectories.find(name);
    if (poses == trajectories.end()) return std::nullopt;
    const auto& query = poses->second.at(to_index(loop.frame));
    const auto& candidate = poses->second.at(to_index(loop.candidate->frame));
    if (!query || !candidate) return std::nullopt;
    return PosePair{*query, *candidate};
}

void add_residual(Json& json,
                  const std::string& when,
                  const FramePose& edge,
                  const std::optional<PosePair>& poses)
{
    if (!poses) return;
    const auto map_to_candidate = poses->candidate.rotation.t();
    const FramePose estimated{
        map_to_candidate * poses->query.rotation,
        map_to_candidate * (poses->query.position - poses->candidate.position)};
    json["residual_" + when + "_m"] = rounded(cv::norm(estimated.position - edge.position), 6);
    json["residual_" + when + "_deg"] =
        rounded(angle_between(estimated, edge) / kRadiansPerDegree, 4);
}

void add_edge(Json& json,
              const FramePose& edge,
              const FrameVerdict& loop,
              const std::map<std::string, PosesOfFrames>& trajectories)
{
    add_residual(json, "before", edge, poses_of(loop, "input", trajectories));
    add_residual(json, "after", edge, poses_of(loop, "optimized", trajectories));
    const auto truth = poses_of(loop, "truth", trajectories);
    if (!truth) return;
    const cv::Vec3d true_position =
        truth->candidate.rotation.t() * (truth->query.position - truth->candidate.position);
    json["truth_error_m"] = rounded(cv::norm(edge.position - true_position), 6);
}
}  // namespace

Json loops_json(const std::vector<FrameVerdict>& frames,
                const std::string& loops_csv,
                const std::map<std::string, PosesOfFrames>& trajectories,
                const std::vector<bool>& page)
{
    std::vector<const FrameVerdict*> accepted;
    for (const auto& frame : frames)
        if (frame.accepted()) accepted.push_back(&frame);
    std::optional<CsvTable> table;
    if (std::filesystem::exists(loops_csv)) table.emplace(loops_csv);
    if (table && table->rows() != accepted.size())
        throw std::runtime_error(loops_csv + " has " + count_of(table->rows(), "loop closure") +
                                 ", frames.csv beside it " + std::to_string(accepted.size()));
    Json loops = Json::array();
    for (std::size_t row = 0; row < accepted.size(); ++row)
    {
        const auto& loop = *accepted[row];
        if (!page.at(to_index(loop.frame))) continue;
        Json json = {{"query", to_index(loop.frame)},
                     {"candidate", to_index(loop.candidate->frame)},
                     {"inliers", loop.inliers}};
        if (table)
        {
            if (const auto weight = table->number(row, "weight")) json["weight"] = *weight;
            if (const auto fate = table->text(row, "edge"); !fate.empty()) json["edge"] = fate;
            if (const auto sigma = vector_of(*table, row, {"sigma_x", "sigma_y", "sigma_z"}))
                json["translation_sd_m"] = rounded(cv::norm(*sigma), 6);
            if (const auto edge = edge_of(*table, row)) add_edge(json, *edge, loop, trajectories);
        }
        loops.push_back(std::move(json));
    }
    return loops;
}

}  // namespace fild
