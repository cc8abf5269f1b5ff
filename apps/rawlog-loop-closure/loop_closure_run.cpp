// SPDX-License-Identifier: BSD-3-Clause
#include "loop_closure_run.h"

#include "fild/features/model_file.h"
#include "fild/rawlog/rawlog_reader.h"
#include "fild/report/cost_csv.h"
#include "fild/report/html_report.h"
#include "fild/report/process_memory.h"
#include "fild/report/run_summary.h"
#include "fild/report/similarity_matrix.h"
#include "fild/report/verdict_csv.h"
#include "interruption.h"
#include "map_files.h"
#include "match_pictures.h"
#include "output_folder.h"
#include "progress_line.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/system/os.h>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
/** Everything a run gathers on its way through the rawlog. */
struct Gathered
{
    Gathered(const OutputFolder& folder, const TRunOptions& options)
        : frames(folder.file("frames.csv")),
          loops(folder.file("loops.csv")),
          candidates(folder.file("candidates.csv")),
          costs(folder.file("costs.csv")),
          pictures(options.render, options.report)
    {
        if (options.report.similarity_frames > 0)
            similarities.emplace(static_cast<std::size_t>(options.report.similarity_frames));
    }

    void add(const DetectorOutcome& outcome, const LoopClosureStream& stream)
    {
        const auto& verdict = outcome.verdict;
        candidates.add(verdict.frame, outcome.considered);
        costs.add(verdict.frame, stream.times(), stream.detector().map_bytes());
        if (similarities) similarities->add(verdict.frame, outcome.global);
        summary.add(verdict);
        verdicts.push_back({verdict, outcome.depth_source});
        if (verdict.candidate)
            pictures.add(outcome,
                         verdicts.at(to_index(verdict.candidate->frame)).verdict.timestamp);
    }

    /** Writes what waits for the map: where depths came from, and what became of each loop. */
    void write_rows(const std::optional<Map>& map)
    {
        std::size_t loop = 0;
        for (auto& [verdict, source] : verdicts)
        {
            if (map && map->frames_with_motion_depth.count(verdict.frame) != 0)
                source = DepthSource::motion;
            frames.add(verdict, to_word(source));
            ++summary.map.depth_sources[to_word(source)];
            if (verdict.accepted())
                loops.add(verdict, to_word(source), map ? row_of(map->loops[loop++]) : LoopRow());
        }
    }

    struct Row
    {
        FrameVerdict verdict;
        DepthSource depth_source = DepthSource::none;
    };

    VerdictCsv frames;
    LoopCsv loops;
    CandidateCsv candidates;
    CostCsv costs;
    std::optional<SimilarityMatrix> similarities;
    RunSummary summary;
    std::vector<Row> verdicts;  ///< of every camera frame
    PairsToDraw pictures;
};

void throw_if_interrupted()
{
    if (interrupted()) throw std::runtime_error("interrupted");
}

/** Feeds the rawlog to the stream until its end, the limit of frames or an interruption. */
void read_frames(const RunRequest& request,
                 RawlogReader& reader,
                 LoopClosureStream& stream,
                 MapBuilder& map,
                 Gathered& gathered)
{
    ProgressLine progress(request.quiet, "loop closures");
    const auto& count = gathered.summary.camera_frames;
    while (count != request.max_frames || count == 0)
    {
        throw_if_interrupted();
        const auto [observation, actions] = reader.next_entry();
        if (!observation && !actions) break;
        if (actions) map.feed(*actions);
        if (!observation) continue;
        map.feed(*observation);
        const auto outcome = stream.feed(*observation);
        if (!outcome) continue;
        map.add(*outcome);
        gathered.add(*outcome, stream);
        const double of_limit =
            request.max_frames == 0
                ? 0
                : static_cast<double>(count) / static_cast<double>(request.max_frames);
        progress.update(
            std::max(reader.fraction_read(), of_limit), count, gathered.summary.loop_closures);
    }
}

std::string no_usable_frame(const FrameBuilder& frames)
{
    const auto missing = frames.first_missing_image();
    if (missing.empty()) return "no frame could be used";
    return "no frame could be used; the first image that is missing is " + missing +
           "; set [input] images_dir to the folder of the images";
}

/** As read_frames(), but an error after the first frame is returned: what came before is good. */
std::string read_what_can_be_read(const RunRequest& request,
                                  RawlogReader& reader,
                                  LoopClosureStream& stream,
                                  MapBuilder& map,
                                  Gathered& gathered)
{
    try
    {
        read_frames(request, reader, stream, map, gathered);
    }
    catch (const std::exception& error)
    {
        if (gathered.summary.camera_frames == 0) throw std::runtime_error(error.what());
        return error.what();
    }
    const auto& summary = gathered.summary;
    if (summary.camera_frames > 0 && summary.usable_frames() > 0) return "";
    if (summary.camera_frames > 0) return no_usable_frame(stream.frames());
    const auto& label = request.options.stream.input.sensor_label;
    const auto wanted = label.empty() ? "" : " that matches [input] sensor_label='" + label + "'";
    throw std::runtime_error(request.rawlog + " has no camera observation" + wanted + "; " +
                             stream.frames().describe_labels());
}

/** The first reason why a run is not whole is its error; those after it are notes. */
void tell_end(const std::string& reason, RunSummary& summary)
{
    if (summary.ended_early.empty())
        summary.ended_early = reason;
    else
        summary.map.notes.push_back(reason);
}

/** Builds the map; an error ends only this, and stands in the summary. */
std::optional<Map> build_what_can_be_built(const MapBuilder& builder,
                                           const LoopDetector& detector,
                                           StageTimes& times,
                                           RunSummary& summary)
{
    try
    {
        auto map = builder.build(detector, times, throw_if_interrupted);
        summary.map = summary_of(map, summary.camera_frames);
        return map;
    }
    catch (const std::exception& error)
    {
        tell_end(std::string("no map: ") + error.what(), summary);
        return std::nullopt;
    }
}

/** Writes the files of the map; an error ends only this. */
void write_what_can_be_written(const RunRequest& request,
                               const Map& map,
                               const OutputFolder& folder,
                               StageTimes& times,
                               RunSummary& summary)
{
    try
    {
        const StageTimer timer(times, "map_files");
        const auto& options = request.options;
        for (auto& note :
             write_map_files(map,
                             {request.rawlog, options.stream.input, summary.camera_frames},
                             options.graph,
                             folder))
            summary.map.notes.push_back(std::move(note));
    }
    catch (const std::exception& error)
    {
        tell_end(std::string("no more map files: ") + error.what(), summary);
    }
}

/** Pairs or depth images that serve no frame at all are told, unless the loops told it already. */
void count_depth_defects(const LoopDetector& detector, RunSummary& summary)
{
    auto& defects = summary.map.depth_defects;
    for (std::size_t i = 0; i < summary.camera_frames; ++i)
        if (const auto* place = detector.find_place(FrameId{i}))
            if (place->metric.depth_defect != DepthDefect::none)
                ++defects[to_word(place->metric.depth_defect)];
    for (const auto& [defect, count] : defects)
        if (count == summary.camera_frames && defect != to_word(DepthDefect::mono) &&
            summary.map.loops_withheld.count(defect) == 0)
            summary.map.notes.push_back("no frame has a depth of its own: " + defect);
}

/** Writes similarity.png; an error ends only this. */
void write_similarities(const OutputFolder& folder, StageTimes& times, Gathered& gathered)
{
    auto& summary = gathered.summary;
    std::filesystem::remove(folder.file("similarity.png"));
    if (!gathered.similarities || summary.usable_frames() == 0) return;
    try
    {
        const StageTimer timer(times, "similarity_matrix");
        gathered.similarities->write_png(folder.file("similarity.png"));
        summary.frames_per_similarity_row = gathered.similarities->frames_per_row();
    }
    catch (const std::exception& error)
    {
        if (summary.ended_early.empty())
            summary.ended_early = std::string("no matrix of similarities: ") + error.what();
    }
}

/** Draws the match pictures; an error or an interruption ends only the drawing. */
void draw_what_can_be_drawn(const RunRequest& request,
                            const OutputFolder& folder,
                            StageTimes& times,
                            Gathered& gathered)
{
    auto& summary = gathered.summary;
    try
    {
        const StageTimer timer(times, "match_pictures");
        summary.match_pictures = draw_match_pictures(gathered.pictures.chosen(),
                                                     request.options.stream.input,
                                                     request.rawlog,
                                                     folder.file("matches"));
        if (interrupted() && summary.ended_early.empty()) summary.ended_early = "interrupted";
    }
    catch (const std::exception& error)
    {
        tell_end(std::string("no more match pictures: ") + error.what(), summary);
    }
}

/** Writes report.html out of the folder's other files; an error ends only this. */
void write_what_can_be_reported(const RunRequest& request, RunSummary& summary)
{
    try
    {
        write_html_report(request.output, request.options.report);
    }
    catch (const std::exception& error)
    {
        if (summary.ended_early.empty())
            summary.ended_early = std::string("no report: ") + error.what();
    }
}

/** Fills in all of the summary that is not counted frame by frame. */
void complete_summary(RunRequest& request, const LoopClosureStream& stream, RunSummary& summary)
{
    summary.command = request.command;
    summary.rawlog = request.rawlog;
    summary.max_frames = request.max_frames;
    summary.clock_jumps = stream.detector().clock_jumps();
    summary.ignored_camera_labels = stream.frames().ignored_camera_labels();
    for (const auto& [name, options] : request.options.sections())
        summary.options.emplace_back(name, options->values());
    summary.versions = {{"mrpt-fild", FILD_VERSION},
                        {"MRPT", mrpt::system::MRPT_getVersion()},
                        {"OpenCV", cv::getVersionString()},
                        {"compiler", __VERSION__}};
    const auto& model = request.options.stream.detector.global_descriptor.model_file;
    summary.model_file = find_model_file(model);
    summary.model_sha256 = sha256_of_file(summary.model_file);
    summary.map_bytes = stream.detector().map_bytes();
    summary.peak_memory_bytes = peak_memory_bytes();
}

void print_result(const RunSummary& summary,
                  const std::string& first_missing_image,
                  const std::string& output)
{
    for (const auto& label : summary.ignored_camera_labels)
        std::cerr << "note: camera " << label
                  << " was not looked at; [input] sensor_label chooses cameras\n";
    const auto missing = summary.frames_by_rejection.find(Rejection::missing_image);
    if (missing != summary.frames_by_rejection.end())
        std::cerr << "note: " << missing->second << " images are missing, the first is "
                  << first_missing_image << "; [input] images_dir names their folder\n";
    if (summary.ended_early.empty())  // else one line says why
        for (const auto& note : summary.map.notes) std::cerr << "note: " << note << "\n";
    std::cout << summary.camera_frames << " frames, " << summary.loop_closures
              << " loop closures, in " << output << "\n";
    for (const auto& [rejection, count] : summary.frames_by_rejection)
        if (rejection != Rejection::none)
            std::cout << "  " << to_word(rejection) << ": " << count << "\n";
    if (summary.map.nodes > 0)
        std::cout << "map: " << summary.map.nodes << " keyframes, " << summary.map.loop_edges
                  << " loop edges\n";
}
}  // namespace

std::vector<std::pair<std::string, Options*>> TRunOptions::sections()
{
    auto all = stream.sections();
    all.emplace_back("graph", &graph);
    all.emplace_back("render", &render);
    all.emplace_back("report", &report);
    return all;
}

void run_loop_closure(RunRequest request)
{
    const auto start = std::chrono::steady_clock::now();
    catch_interruption();
    cv::setNumThreads(1);  // our own threads are enough, and OpenCV's may not repeat
    const auto& options = request.options;
    RawlogReader reader(request.rawlog);
    LoopClosureStream stream(options.stream, request.rawlog);
    const OutputFolder folder(request.output);

    // Written last: the summary marks a whole set, and the report is made of it.
    for (const auto* last : {"summary.json", "report.html"})
        std::filesystem::remove(folder.file(last));
    Gathered gathered(folder, options);
    MapBuilder builder(options.stream.detector, options.graph);
    auto& summary = gathered.summary;
    summary.ended_early = read_what_can_be_read(request, reader, stream, builder, gathered);
    gathered.candidates.commit();
    gathered.costs.commit();
    auto times = stream.times();
    const auto map = build_what_can_be_built(builder, stream.detector(), times, summary);
    gathered.write_rows(map);
    gathered.frames.commit();
    gathered.loops.commit();
    remove_map_files(folder);
    if (map) write_what_can_be_written(request, *map, folder, times, summary);
    write_similarities(folder, times, gathered);
    draw_what_can_be_drawn(request, folder, times, gathered);
    count_depth_defects(stream.detector(), summary);
    summary.stage_times = times.statistics();
    complete_summary(request, stream, summary);
    summary.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write_summary(summary, folder.file("summary.json"));
    if (options.report.write_html) write_what_can_be_reported(request, summary);
    print_result(summary, stream.frames().first_missing_image(), request.output);
    if (!summary.ended_early.empty())
        throw std::runtime_error(summary.ended_early + "; the results of the " +
                                 std::to_string(summary.camera_frames) + " frames before are in " +
                                 request.output);
}

}  // namespace fild
