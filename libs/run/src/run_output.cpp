// SPDX-License-Identifier: BSD-3-Clause
#include "run_output.h"

#include "fild/core/process_memory.h"
#include "fild/evaluation/evaluation_report.h"
#include "fild/features/model_file.h"
#include "fild/graph/graph_files.h"
#include "fild/job/interruption.h"
#include "fild/run/judged_run.h"
#include "frame_notes.h"
#include "map_files.h"
#include "map_pictures.h"
#include "second_pass.h"

#include <mrpt/system/os.h>
#include <opencv2/core/utility.hpp>

#include <array>
#include <ctime>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
constexpr RunStep kMapFiles{"no more map files", "map_files"};
constexpr RunStep kMapPictures{"no more map pictures", "map_pictures"};
constexpr RunStep kMatchPictures{"no more match pictures", "match_pictures"};

std::string utc_now()
{
    const std::time_t now = std::time(nullptr);
    std::tm date{};
    gmtime_r(&now, &date);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &date);
    return text.data();
}

std::set<FrameId> keys_of(const std::map<FrameId, DrawnCamera>& cameras)
{
    std::set<FrameId> keys;
    for (const auto& [frame, ignored] : cameras) keys.insert(frame);
    return keys;
}
}  // namespace

RunOutput::RunOutput(const RunRequest& request,
                     const OutputFolder& folder,
                     const LoopClosureStream& stream,
                     RunRecord& record)
    : request_(request),
      folder_(folder),
      stream_(stream),
      record_(record),
      steps_(record.summary, stream.times())
{
}

void RunOutput::write_results(const MapBuilder& builder)
{
    // Removed first and written last: they mark a whole set of results.
    for (const auto* last : {"summary.json", "report.html"})
        attempt({"the results of an earlier run are in the way"},
                [&] { std::filesystem::remove(folder_.file(last)); });
    record_.commit();
    attempt({"the map of an earlier run is in the way"}, [&] { remove_map_files(folder_); });
    attempt({"no map"}, [&] { build_map(builder); });
    attempt(kMapFiles, [&] { write_map_files(); });
    attempt({"no comparison with the ground truth"}, [&] { judge(); });
    attempt({"no matrix of similarities", "similarity_matrix"}, [&] { write_similarities(); });
    draw();
    attempt({"no lists of wrong and missed loops"}, [&] { list_wrong_and_missed(); });
    add_notes_on_depths(
        record_.summary, stream_.places(), request_.options.stream.detector.relative_pose);
}

void RunOutput::write_summary_and_report(std::chrono::steady_clock::time_point start)
{
    complete_summary(start);
    auto& summary = record_.summary;
    const auto path = folder_.file("summary.json");
    write_summary(summary, path);
    const auto& options = request_.options.report;
    if (!options.write_html) return;
    const bool was_complete = summary.ended_early.empty();
    attempt({"no report"}, [&] { write_html_report(request_.output, options, truth_); });
    if (!was_complete || summary.ended_early.empty()) return;
    std::filesystem::remove(path);  // else it would still call the run complete
    write_summary(summary, path);
}

bool RunOutput::attempt(const RunStep& step, const std::function<void()>& body)
{
    return steps_.attempt(step, body);
}

void RunOutput::build_map(const MapBuilder& builder)
{
    map_.emplace(builder.build(stream_.places(), steps_.times(), throw_if_interrupted));
    auto& summary = record_.summary;
    summary.map = summary_of(*map_, summary.camera_frames, request_.options.graph);
    record_.add_map(*map_);
}

void RunOutput::write_map_files()
{
    if (!map_) return;
    auto& summary = record_.summary;
    for (auto& note :
         fild::write_map_files(*map_, summary.camera_frames, request_.options.graph, folder_))
        summary.map.notes.push_back(std::move(note));
}

void RunOutput::judge()
{
    if (!request_.truth) return;
    const double delay_seconds = request_.options.stream.detector.index.delay_seconds;
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

void RunOutput::write_similarities()
{
    std::filesystem::remove(folder_.file("similarity.png"));
    auto& summary = record_.summary;
    if (!record_.similarities || summary.usable_frames() == 0) return;
    record_.similarities->write_png(folder_.file("similarity.png"));
    summary.frames_per_similarity_row = record_.similarities->frames_per_row();
}

/** All that takes observations or images out of the rawlog once more: map.simplemap, the pictures
 *  of the map, those of matches. Without a pose there is no map: write_map_files() has said so. */
void RunOutput::draw()
{
    const auto& options = request_.options;
    const auto& render = options.render;
    const bool has_map = map_ && !map_->optimized.empty();
    const bool map_is_drawn = has_map && render.enabled && render.write_map_pictures;
    SecondPass pass(request_.rawlog, options.stream.input, steps_);

    std::map<FrameId, DrawnCamera> cameras;
    if (map_is_drawn) cameras = cameras_of(*map_, stream_.places(), render);
    if (render.camera_images)
        pass.add({kMapPictures, keys_of(cameras), [&](const Frame& frame) {
                      cameras.at(frame.id).image = frame.image.clone();
                  }});
    std::optional<MatchPictures> matches;
    attempt(kMatchPictures,
            [&]
            {
                matches.emplace(pairs_to_draw(),
                                render,
                                options.stream.detector.runtime.num_threads,
                                folder_.file("matches"));
                pass.add({kMatchPictures, matches->wanted(), [&](const Frame& frame) {
                              matches->take(frame);
                          }});
            });
    if (has_map && options.graph.simple_map)
        attempt(kMapFiles,
                [&]
                {
                    write_simple_map(folder_.file("map.simplemap"),
                                     map_->graph,
                                     [&](FrameId frame) { return pass.observations_at(frame); });
                });
    attempt({"no more pictures", "second_pass"}, [&] { pass.finish(); });
    if (matches)
        attempt(kMatchPictures, [&] { record_.summary.match_pictures = matches->finish(); });
    if (map_is_drawn && !interrupted()) attempt(kMapPictures, [&] { draw_map(cameras); });
    if (interrupted() && record_.summary.ended_early.empty())
        record_.summary.ended_early = "interrupted";
}

void RunOutput::draw_map(const std::map<FrameId, DrawnCamera>& cameras)
{
    const auto& render = request_.options.render;
    auto drawn = to_drawn_map(*map_, record_.verdicts, render);
    for (const auto& [frame, camera] : cameras) drawn.cameras.push_back(camera);
    if (truth_) add_judgements(drawn, truth_->evaluation.frames);
    if (truth_ && !truth_->poses.empty()) drawn.ground_truth = true_way_over(*map_, truth_->poses);
    write_map_pictures(drawn, render, folder_);
}

std::vector<LoopPicture> RunOutput::pairs_to_draw() const
{
    const auto& options = request_.options;
    auto pairs = record_.pictures.chosen(wrong_frames());
    add_matches(
        pairs, stream_.places(), options.stream.detector, options.render.draw_rejected_matches);
    if (map_ && options.render.match_pictures_3d) add_cameras(pairs, *map_, stream_.places());
    return pairs;
}

std::set<FrameId> RunOutput::wrong_frames() const
{
    std::set<FrameId> frames;
    if (truth_)
        for (const auto& wrong : truth_->evaluation.score.wrong_loops)
            frames.insert(wrong.verdict.frame);
    return frames;
}

/** Fills in all that is not counted frame by frame. */
void RunOutput::complete_summary(std::chrono::steady_clock::time_point start)
{
    auto& summary = record_.summary;
    summary.command = request_.command;
    summary.rawlog = request_.rawlog;
    summary.max_frames = request_.max_frames;
    auto all_options = request_.options;
    for (const auto& [name, options] : all_options.sections())
        summary.options.emplace_back(name, options->values());
    summary.versions = {{"mrpt-fild", FILD_VERSION},
                        {"MRPT", mrpt::system::MRPT_getVersion()},
                        {"OpenCV", cv::getVersionString()},
                        {"compiler", __VERSION__}};
    summary.model_file =
        find_model_file(request_.options.stream.detector.global_descriptor.model_file);
    summary.model_sha256 = sha256_of_file(summary.model_file);
    summary.map_bytes = stream_.map_bytes();
    summary.peak_memory_bytes = peak_memory_bytes();
    summary.stage_times = steps_.times().statistics();
    summary.finished = utc_now();
    summary.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace fild
