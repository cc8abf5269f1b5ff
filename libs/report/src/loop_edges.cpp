// SPDX-License-Identifier: BSD-3-Clause
#include "loop_edges.h"

#include "fild/core/angle.h"
#include "fild/core/words.h"
#include "fild/results/loops_csv.h"
#include "rounded.h"

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

cv::Vec3d vector_of(const LoopRow::Three& three)
{
    return {three[0], three[1], three[2]};
}

/** candidate_from_query of a loop closure that has a scale. */
std::optional<FramePose> edge_of(const LoopRow& loop)
{
    if (!loop.position || !loop.angles) return std::nullopt;
    const auto& [yaw, pitch, roll] = *loop.angles;
    return FramePose{rotation_about(2, yaw) * rotation_about(1, pitch) * rotation_about(0, roll),
                     vector_of(*loop.position)};
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
    const bool has_file = std::filesystem::exists(loops_csv);
    const auto rows = has_file ? read_loops_csv(loops_csv) : std::vector<LoopRow>(accepted.size());
    if (rows.size() != accepted.size())
        throw std::runtime_error(loops_csv + " has " + count_of(rows.size(), "loop closure") +
                                 ", frames.csv beside it " + std::to_string(accepted.size()));
    Json loops = Json::array();
    for (std::size_t i = 0; i < accepted.size(); ++i)
    {
        const auto& loop = *accepted[i];
        const auto& row = rows[i];
        if (!page.at(to_index(loop.frame))) continue;
        Json json = {{"query", to_index(loop.frame)},
                     {"candidate", to_index(loop.candidate->frame)},
                     {"inliers", loop.inliers}};
        if (row.weight) json["weight"] = *row.weight;
        if (!row.edge.empty()) json["edge"] = row.edge;
        if (row.position_deviations)
            json["translation_sd_m"] = rounded(cv::norm(vector_of(*row.position_deviations)), 6);
        if (const auto edge = edge_of(row)) add_edge(json, *edge, loop, trajectories);
        loops.push_back(std::move(json));
    }
    return loops;
}

}  // namespace fild
