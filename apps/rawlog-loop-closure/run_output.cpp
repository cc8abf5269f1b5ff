// SPDX-License-Identifier: BSD-3-Clause
#include "run_output.h"

#include "error_line.h"
#include "fild/core/process_memory.h"
#include "fild/evaluation/evaluation_report.h"
#include "fild/features/model_file.h"
#include "interruption.h"
#include "judged_run.h"
#include "map_files.h"
#include "map_pictures.h"
#include "match_pictures.h"

#include <mrpt/system/os.h>
#include <opencv2/core/utility.hpp>

#include <array>
#include <ctime>
#include <filesystem>
#include <utility>

namespace fild
{
namespace
{
std::string utc_now()
{
    const std::time_t now = std::time(nullptr);
    std::tm date{};
    gmtime_r(&now, &date);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &date);
    return text.data();
}
}  // namespace

RunOutput::RunOutput(const RunRequest& request,
                     const OutputFolder& folder,
                     const LoopClosureStream& stream,
                     Gathered& gathered)
    : request_(request),
      options_(request.options),
      folder_(folder),
      stream_(stream),
      gathered_(gathered),
      summary_(gathered.summary),
      times_(stream.times())
{
}

void RunOutput::write_results(const MapBuilder& builder)
{
    // Removed first and written last: they mark a whole set of results.
    for (const auto* last : {"summary.json", "report.html"})
        attempt("the results of an earlier run are in the way",
                [&] { std::filesystem::remove(folder_.file(last)); });
    gathered_.commit_verdicts();
    attempt("the map of an earlier run is in the way", [&] { remove_map_files(folder_); });
    attempt("no map", [&] { build_map(builder); });
    attempt("no more map files", [&] { write_map_files(); });
    attempt("no comparison with the ground truth", [&] { judge(); });
    attempt("no more map pictures", [&] { draw_map(); });
    attempt("no matrix of similarities", [&] { write_similarities(); });
    attempt("no more match pictures", [&] { draw_matches(); });
    attempt("no lists of wrong and missed loops", [&] { list_wrong_and_missed(); });
    count_depth_defects();
    if (options_.stream.detector.relative_pose.enabled) note_sparse_depths();
}

void RunOutput::write_summary_and_report(std::chrono::steady_clock::time_point start)
{
    complete_summary(start);
    const auto path = folder_.file("summary.json");
    write_summary(summary_, path);
    if (!options_.report.write_html) return;
    const bool was_complete = summary_.ended_early.empty();
    attempt("no report", [&] { write_html_report(request_.output, options_.report, truth_); });
    if (!was_complete || summary_.ended_early.empty()) return;
    std::filesystem::remove(path);  // else it would still call the run complete
    write_summary(summary_, path);
}

void RunOutput::attempt(const std::string& what_fails, const std::function<void()>& step)
{
    try
    {
        step();
    }
    catch (const Interrupted& interruption)
    {
        if (summary_.ended_early.empty()) summary_.ended_early = interruption.what();
    }
    catch (const std::exception& error)
    {
        const auto reason = what_fails + ": " + error_line(error);
        if (summary_.ended_early.empty())
            summary_.ended_early = reason;
        else
            summary_.map.notes.push_back(reason);
    }
}

void RunOutput::build_map(const MapBuilder& builder)
{
    map_.emplace(builder.build(stream_.places(), times_, throw_if_interrupted));
    summary_.map = summary_of(*map_, summary_.camera_frames, options_.graph);
    gathered_.add_map(*map_);
}

void RunOutput::write_map_files()
{
    if (!map_) return;
    const StageTimer timer(times_, "map_files");
    const MappedRawlog rawlog{request_.rawlog, options_.stream.input, summary_.camera_frames};
    for (auto& note : fild::write_map_files(*map_, rawlog, options_.graph, folder_))
        summary_.map.notes.push_back(std::move(note));
}

void RunOutput::judge()
{
    if (!request_.truth) return;
    const double delay_seconds = options_.stream.detector.index.delay_seconds;
    truth_ = judge_run(request_.output, *request_.truth, delay_seconds);
}

/** After the pictures, which the lists name. */
void RunOutput::list_wrong_and_missed()
{
    for (const auto* name : {"wrong_loops.csv", "missed_loops.csv"})
        std::filesystem::remove(folder_.file(name));
    if (truth_)
        write_wrong_and_missed_loops({truth_->description, {}, {truth_->evaluation}},
                                     request_.output);
}

/** Without a pose there is nothing to draw: write_map_files() has said so. */
void RunOutput::draw_map()
{
    const auto& render = options_.render;
    if (!map_ || map_->optimized.empty() || !render.enabled || !render.write_map_pictures ||
        interrupted())
        return;
    const StageTimer timer(times_, "map_pictures");
    auto drawn = to_drawn_map(*map_, gathered_.verdicts, render);
    drawn.cameras =
        cameras_of(*map_, stream_.places(), render, options_.stream.input, request_.rawlog);
    if (truth_) add_judgements(drawn, truth_->evaluation.frames);
    if (truth_ && !truth_->poses.empty()) drawn.ground_truth = true_way_over(*map_, truth_->poses);
    write_map_pictures(drawn, render, folder_);
}

std::set<FrameId> RunOutput::wrong_frames() const
{
    std::set<FrameId> frames;
    if (truth_)
        for (const auto& wrong : truth_->evaluation.score.wrong_loops)
            frames.insert(wrong.verdict.frame);
    return frames;
}

void RunOutput::write_similarities()
{
    std::filesystem::remove(folder_.file("similarity.png"));
    if (!gathered_.similarities || summary_.usable_frames() == 0) return;
    const StageTimer timer(times_, "similarity_matrix");
    gathered_.similarities->write_png(folder_.file("similarity.png"));
    summary_.frames_per_similarity_row = gathered_.similarities->frames_per_row();
}

void RunOutput::draw_matches()
{
    const StageTimer timer(times_, "match_pictures");
    auto pairs = gathered_.pictures.chosen(wrong_frames());
    const auto& detector = options_.stream.detector;
    add_matches(pairs, stream_.places(), detector, options_.render.draw_rejected_matches);
    if (map_ && options_.render.match_pictures_3d) add_cameras(pairs, *map_, stream_.places());
    const DrawnRawlog rawlog{request_.rawlog, options_.stream.input, detector.runtime.num_threads};
    summary_.match_pictures =
        draw_match_pictures(pairs, options_.render, rawlog, folder_.file("matches"));
    if (interrupted() && summary_.ended_early.empty()) summary_.ended_early = "interrupted";
}

/** Pairs or depth images that serve no frame at all are told, unless the loops told it already. */
void RunOutput::count_depth_defects()
{
    auto& defects = summary_.map.depth_defects;
    for (std::size_t i = 0; i < summary_.camera_frames; ++i)
        if (const auto* place = stream_.places().find(FrameId{i}))
            if (place->metric.depth_defect != DepthDefect::none)
                ++defects[to_word(place->metric.depth_defect)];
    for (const auto& [defect, count] : defects)
        if (count == summary_.camera_frames && defect != to_word(DepthDefect::mono) &&
            summary_.map.loops_withheld.count(defect) == 0)
            summary_.map.notes.push_back("no frame has a depth of its own: " + defect);
}

/** Stereo pairs and depth images that are there, and yet of little use. */
void RunOutput::note_sparse_depths()
{
    constexpr std::size_t kEnoughKeypoints = 100;
    constexpr std::size_t kEnoughFrames = 8;
    const auto least = static_cast<std::size_t>(options_.stream.detector.relative_pose.min_points);
    std::size_t looked_at = 0;
    std::size_t sparse = 0;
    for (std::size_t i = 0; i < summary_.camera_frames; ++i)
    {
        const auto* place = stream_.places().find(FrameId{i});
        if (place == nullptr || place->metric.depth_defect != DepthDefect::none ||
            !place->metric.camera || place->local.positions.size() < kEnoughKeypoints)
            continue;
        ++looked_at;
        if (place->metric.depths.known() < least) ++sparse;
    }
    if (looked_at < kEnoughFrames || 2 * sparse < looked_at) return;
    const auto& pair = summary_.stereo_pair;
    const auto which = pair ? " of cameras '" + pair->left + "' and '" + pair->right + "'" : "";
    summary_.map.notes.push_back(
        std::to_string(sparse) + " of " + std::to_string(looked_at) +
        " frames have a depth for fewer than " + std::to_string(least) +
        " keypoints: are left and right image" + which +
        " swapped, or their calibration or poses wrong, or is all further away than [depth] "
        "max_relative_deviation allows?" +
        (pair ? " [input] stereo_labels = none takes one camera" : ""));
}

/** Fills in all that is not counted frame by frame. */
void RunOutput::complete_summary(std::chrono::steady_clock::time_point start)
{
    summary_.command = request_.command;
    summary_.rawlog = request_.rawlog;
    summary_.max_frames = request_.max_frames;
    auto all_options = options_;
    for (const auto& [name, options] : all_options.sections())
        summary_.options.emplace_back(name, options->values());
    summary_.versions = {{"mrpt-fild", FILD_VERSION},
                         {"MRPT", mrpt::system::MRPT_getVersion()},
                         {"OpenCV", cv::getVersionString()},
                         {"compiler", __VERSION__}};
    summary_.model_file = find_model_file(options_.stream.detector.global_descriptor.model_file);
    summary_.model_sha256 = sha256_of_file(summary_.model_file);
    summary_.map_bytes = stream_.map_bytes();
    summary_.peak_memory_bytes = peak_memory_bytes();
    summary_.stage_times = times_.statistics();
    summary_.finished = utc_now();
    summary_.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace fild
