// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/ground_truth.h"

#include "fild/core/words.h"
#include "number_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
enum class Format
{
    loop_matrix,
    loop_list,
    tum_poses,
    kitti_poses
};

/** The first bytes of a MATLAB file of version 5 or 7.3, or an extension that says so. */
bool is_matlab_file(const std::string& path)
{
    std::array<char, 6> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    return std::string(start.data(), start.size()) == "MATLAB" ||
           std::filesystem::path(path).extension() == ".mat";
}

Format format_of(const std::string& path)
{
    if (!std::filesystem::exists(path))
        throw std::runtime_error("no such ground-truth file: '" + path + "'");
    if (is_matlab_file(path)) return Format::loop_matrix;
    const auto rows = read_number_rows(path, 1);
    if (rows.empty()) throw std::runtime_error("no loop and no pose in " + path);
    switch (rows[0].values.size())
    {
        case 2:
        case 3:
            return Format::loop_list;
        case 8:
            return Format::tum_poses;
        case 12:
            return Format::kitti_poses;
        default:
            throw std::runtime_error(rows[0].origin + ": " +
                                     count_of(rows[0].values.size(), "number") +
                                     "; ground truth has 2 (QUERY CANDIDATE), 3 (QUERY "
                                     "CANDIDATE 0), 8 (TUM pose) "
                                     "or 12 (KITTI pose) a line, or is a MATLAB file");
    }
}

void require_same_length(const LoopLabels& labels, std::size_t frames, const std::string& path)
{
    if (labels.frames && *labels.frames != frames)
        throw std::runtime_error(path + " labels " + count_of(*labels.frames, "frame") +
                                 ", the run has " + std::to_string(frames) +
                                 "; is it the truth of this recording?");
    if (labels.earlier_frames.empty() && labels.doubtful.empty())
        throw std::runtime_error("no loop in " + path);
    auto queries = std::set<std::size_t>();
    for (const auto& labelled : labels.earlier_frames) queries.insert(labelled.first);
    for (const auto& pair : labels.doubtful) queries.insert(pair.first);
    for (const auto query : queries)
        if (query >= frames)
            throw std::runtime_error(path + " names frame " + std::to_string(query) +
                                     ", the run has " + count_of(frames, "frame") +
                                     " from 0; is it the truth of this recording?");
}

std::vector<std::string> remarks_on(const LoopLabels& labels)
{
    std::vector<std::string> remarks;
    if (labels.transposed)
        remarks.emplace_back(
            "most entries are above the diagonal: stored transposed, rows and columns swapped");
    if (labels.mirrored > 0)
        remarks.push_back(count_of(labels.mirrored, "entry repeats", "entries repeat") +
                          " one below the diagonal above it: ignored");
    if (labels.on_diagonal > 0)
        remarks.push_back(count_of(labels.on_diagonal, "entry", "entries") +
                          " on the diagonal: ignored");
    if (labels.dropped > 0)
        remarks.push_back(count_of(labels.dropped, "entry", "entries") +
                          " above the diagonal: a label error, dropped");
    if (const auto count = labels.unanswerable_queries(); count > 0)
        remarks.push_back(count_of(count, "loop query has", "loop queries have") +
                          " no other entry: cannot be answered, counts as missed, as in published "
                          "numbers");
    return remarks;
}

GroundTruth load_labels(const std::string& path,
                        Format format,
                        std::size_t frames,
                        const Protocol& protocol)
{
    if (protocol.kind == Protocol::Kind::radius)
        throw std::invalid_argument(path + " holds labels, not poses: the protocol must be exact " +
                                    "or window:N");
    const bool matrix = format == Format::loop_matrix;
    auto labels = matrix ? read_loop_matrix(path) : read_loop_list(path);
    require_same_length(labels, frames, path);
    GroundTruth ground_truth;
    ground_truth.content = (matrix ? "loop matrix of " + std::to_string(frames) + " frames, "
                                   : std::string("list of loops, ")) +
                           count_of(labels.pairs, "pair", "pairs");
    if (!labels.doubtful.empty())
        ground_truth.content += ", " + std::to_string(labels.doubtful.size()) + " doubtful";
    ground_truth.remarks = remarks_on(labels);
    const auto window = protocol.kind == Protocol::Kind::window ? protocol.window : 0;
    ground_truth.truth = std::make_unique<LabelTruth>(std::move(labels), window);
    return ground_truth;
}

std::size_t count_known(const std::vector<PosedFrame>& frames)
{
    return static_cast<std::size_t>(std::count_if(
        frames.begin(), frames.end(), [](const PosedFrame& frame) { return frame.pose; }));
}

TruePoses true_poses(std::vector<PosedFrame> frames, const std::string& content)
{
    const auto known = count_known(frames);
    const auto unknown = frames.size() - known;
    TruePoses poses;
    poses.content = content + " of " + count_of(known, "frame", "frames");
    if (unknown > 0)
        poses.remarks.push_back(count_of(unknown, "frame has", "frames have") + " no pose");
    poses.frames = std::move(frames);
    return poses;
}

TruePoses load_poses(const std::string& path,
                     Format format,
                     const std::vector<FrameVerdict>& frames)
{
    if (format == Format::kitti_poses)
        return true_poses(read_kitti_poses(path, frames), "KITTI poses");
    constexpr double kSameClock = 1;  // s
    auto tum = read_tum_poses(path, frames);
    auto poses = true_poses(std::move(tum.frames), "TUM poses");
    if (tum.seconds_off > kSameClock)
        poses.remarks.push_back("its times are up to " +
                                std::to_string(std::llround(tum.seconds_off)) +
                                " s away from those of the frames: line i was taken for frame i");
    return poses;
}

bool holds_labels(Format format)
{
    return format == Format::loop_matrix || format == Format::loop_list;
}

void require_radius(const std::string& what, const Protocol& protocol)
{
    if (protocol.kind != Protocol::Kind::radius)
        throw std::invalid_argument(what + " holds poses, not labels: the protocol must be " +
                                    "radius:R");
}
}  // namespace

GroundTruth load_ground_truth(const std::string& path,
                              const std::vector<FrameVerdict>& frames,
                              const Protocol& protocol)
{
    const auto format = format_of(path);
    if (holds_labels(format)) return load_labels(path, format, frames.size(), protocol);
    require_radius(path, protocol);
    return ground_truth_of(load_poses(path, format, frames), protocol);
}

bool holds_poses(const std::string& path)
{
    return !holds_labels(format_of(path));
}

TruePoses load_true_poses(const std::string& path, const std::vector<FrameVerdict>& frames)
{
    const auto format = format_of(path);
    if (holds_labels(format)) throw std::runtime_error(path + " holds labels, not poses");
    return load_poses(path, format, frames);
}

TruePoses true_poses_along(const MeasuredPath& path,
                           const std::string& content,
                           const std::vector<FrameVerdict>& frames)
{
    auto posed = poses_along(path, frames);
    if (count_known(posed) == 0)
        throw std::runtime_error("no frame was taken while " + content +
                                 " knew the pose; is it the truth of this recording?");
    auto poses = true_poses(std::move(posed), content);
    poses.oriented = path.oriented;
    return poses;
}

GroundTruth ground_truth_of(TruePoses poses, const Protocol& protocol)
{
    require_radius("the ground truth", protocol);
    GroundTruth ground_truth;
    ground_truth.content = poses.content;
    ground_truth.remarks = poses.remarks;
    ground_truth.truth = std::make_unique<PoseTruth>(poses.frames, protocol);
    ground_truth.poses = std::move(poses);
    return ground_truth;
}

}  // namespace fild
