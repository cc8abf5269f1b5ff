// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/run_summary.h"

#include "fild/core/parse_number.h"
#include "fild/core/whole_file.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <openssl/evp.h>
#include <stdexcept>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

double rounded(double value)
{
    return std::round(value * 1000) / 1000;
}

/** Null without a pair. */
Json pair_json(const std::optional<PairSummary>& pair)
{
    if (!pair) return nullptr;
    return {{"left", pair->left},
            {"right", pair->right},
            {"frames_with_right_image", pair->frames_with_right_image},
            {"frames_without", pair->frames_without},
            {"right_images_alone", pair->right_images_alone}};
}

Json frames_json(const RunSummary& summary)
{
    Json rejections = Json::object();
    for (const auto rejection : all_rejections())
    {
        const auto count = summary.frames_by_rejection.find(rejection);
        if (rejection != Rejection::none && count != summary.frames_by_rejection.end())
            rejections[to_word(rejection)] = count->second;
    }
    return {{"camera_frames", summary.camera_frames},
            {"loop_closures", summary.loop_closures},
            {"rejections", rejections},
            {"clock_jumps", summary.clock_jumps},
            {"scaled_frames", summary.scaled_frames},
            {"mean_keypoints", rounded(summary.mean_keypoints)},
            {"match_pictures", summary.match_pictures},
            {"frames_per_similarity_row", summary.frames_per_similarity_row},
            {"ignored_camera_labels", summary.ignored_camera_labels},
            {"stereo_pair", pair_json(summary.stereo_pair)},
            {"notes", summary.frame_notes}};
}

Json counts_json(const std::map<std::string, std::size_t>& counts)
{
    Json result = Json::object();
    for (const auto& [word, count] : counts) result[word] = count;
    return result;
}

Json sources_json(const std::vector<MotionSourceSummary>& sources)
{
    Json all = Json::array();
    for (const auto& source : sources)
        all.push_back({{"kind", source.kind},
                       {"name", source.name},
                       {"factors", source.factors},
                       {"without_weight", source.without_weight},
                       {"contradictions", source.contradictions},
                       {"noise_scale", rounded(source.noise_scale)},
                       {"left_out", source.left_out}});
    return all;
}

/** Null for a map that is not geo-referenced. */
Json origin_json(const std::optional<MapOrigin>& origin)
{
    if (!origin) return nullptr;
    return {{"latitude_deg", origin->latitude_deg},
            {"longitude_deg", origin->longitude_deg},
            {"height_m", origin->height_m}};
}

Json map_json(const MapSummary& map)
{
    return {{"trajectory", map.trajectory},
            {"trajectory_source", map.trajectory_source},
            {"other_sources", map.other_sources},
            {"sources", sources_json(map.sources)},
            {"loop_noise_scale", rounded(map.loop_noise_scale)},
            {"motion_noise_scale", rounded(map.motion_noise_scale)},
            {"origin", origin_json(map.origin)},
            {"frames_without_pose", map.frames_without_pose},
            {"resets", map.resets},
            {"gaps", map.gaps},
            {"clock_jumps", map.clock_jumps},
            {"late_readings", map.late_readings},
            {"unusable_readings", map.unusable_readings},
            {"implausible_readings", map.implausible_readings},
            {"depth_sources", counts_json(map.depth_sources)},
            {"depth_defects", counts_json(map.depth_defects)},
            {"nodes", map.nodes},
            {"odometry_edges", map.odometry_edges},
            {"loop_edges", map.loop_edges},
            {"loops_without_weight", counts_json(map.loops_without_weight)},
            {"loops_withheld", counts_json(map.loops_withheld)},
            {"chi2_before", rounded(map.chi2_before)},
            {"chi2_after", rounded(map.chi2_after)},
            {"parts", map.parts},
            {"is_largest_set", map.is_largest_set},
            {"optimizations", map.optimizations},
            {"notes", map.notes}};
}

Json options_json(const RunSummary::OptionValues& options)
{
    Json sections = Json::object();
    for (const auto& [section, values] : options)
    {
        Json keys = Json::object();
        for (const auto& [key, value] : values) keys[key] = value;
        sections[section] = keys;
    }
    return sections;
}

Json times_json(const std::map<std::string, StageTimes::Statistics>& stages)
{
    Json result = Json::object();
    for (const auto& [stage, statistics] : stages)
        result[stage] = {{"calls", statistics.calls},
                         {"mean", rounded(statistics.mean_ms)},
                         {"median", rounded(statistics.median_ms)},
                         {"p95", rounded(statistics.p95_ms)},
                         {"max", rounded(statistics.max_ms)},
                         {"total", rounded(statistics.total_ms)}};
    return result;
}

Json memory_json(const RunSummary& summary)
{
    const auto frames = std::max<std::size_t>(1, summary.camera_frames);
    return {{"peak_bytes", summary.peak_memory_bytes},
            {"map_bytes", summary.map_bytes},
            {"map_bytes_per_frame", summary.map_bytes / frames}};
}
}  // namespace

void RunSummary::add(const FrameVerdict& verdict)
{
    ++camera_frames;
    ++frames_by_rejection[verdict.rejection];
    if (verdict.accepted()) ++loop_closures;
    const auto weight = 1.0 / static_cast<double>(camera_frames);
    mean_keypoints += (static_cast<double>(verdict.keypoints) - mean_keypoints) * weight;
}

std::size_t RunSummary::usable_frames() const
{
    std::size_t usable = camera_frames;
    for (const auto& [rejection, count] : frames_by_rejection)
        if (is_unusable(rejection)) usable -= count;
    return usable;
}

void write_summary(const RunSummary& summary, const std::string& path)
{
    Json versions = Json::object();
    for (const auto& [name, version] : summary.versions) versions[name] = version;
    const Json json = {
        {"command", summary.command},
        {"rawlog", summary.rawlog},
        {"max_frames", summary.max_frames},
        {"complete", summary.ended_early.empty()},
        {"ended_early", summary.ended_early},
        {"frames", frames_json(summary)},
        {"map", map_json(summary.map)},
        {"options", options_json(summary.options)},
        {"versions", versions},
        {"model", {{"file", summary.model_file}, {"sha256", summary.model_sha256}}},
        {"stage_times_ms", times_json(summary.stage_times)},
        {"wall_seconds", rounded(summary.wall_seconds)},
        {"finished", summary.finished},
        {"memory", memory_json(summary)},
    };
    WholeFile file(path);
    file.stream() << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    file.commit();
}

std::optional<double> read_run_delay(const std::string& path)
{
    std::ifstream file(path);
    const auto json = Json::parse(file, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    const Json::json_pointer pointer("/options/index/delay_seconds");
    if (!json.contains(pointer) || !json.at(pointer).is_string()) return std::nullopt;
    return parse_number<double>(json.at(pointer).get<std::string>());
}

std::string sha256_of_file(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                          &EVP_MD_CTX_free);
    EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
    std::array<char, 65536> block{};
    while (file.read(block.data(), block.size()), file.gcount() > 0)
        EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(file.gcount()));
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    EVP_DigestFinal_ex(context.get(), digest.data(), &length);
    std::string hexadecimal;
    for (unsigned int i = 0; i < length; ++i)
    {
        constexpr const char* kDigits = "0123456789abcdef";
        hexadecimal += kDigits[digest[i] >> 4U];
        hexadecimal += kDigits[digest[i] & 15U];
    }
    return hexadecimal;
}

}  // namespace fild
