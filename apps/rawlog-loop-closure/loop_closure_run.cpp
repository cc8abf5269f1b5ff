// SPDX-License-Identifier: BSD-3-Clause
#include "loop_closure_run.h"

#include "error_line.h"
#include "fild/mapping/map_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "gathered.h"
#include "interruption.h"
#include "output_folder.h"
#include "progress_line.h"
#include "run_output.h"
#include "standard_streams.h"

#include <mrpt/obs/CObservation.h>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
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
        if (gathered.summary.camera_frames == 0) throw std::runtime_error(error_line(error));
        return error_line(error);
    }
    const auto& summary = gathered.summary;
    if (summary.camera_frames > 0 && summary.usable_frames() > 0) return "";
    if (summary.camera_frames > 0) return no_usable_frame(stream.frames());
    const auto& label = request.options.stream.input.sensor_label;
    const auto wanted = label.empty() ? "" : " that matches [input] sensor_label='" + label + "'";
    throw std::runtime_error(request.rawlog + " has no camera observation" + wanted + "; " +
                             stream.frames().describe_labels());
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
    if (summary.scaled_frames > 0)
        std::cerr << "note: " << summary.scaled_frames
                  << " images were scaled to the size of their camera's first image\n";
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

/** In one line: the rest is in the report. */
void print_evaluation(const RunEvaluation& evaluation)
{
    std::cout << std::fixed << std::setprecision(3)
              << "against the ground truth: " << evaluation.score.wrong_loops.size()
              << " wrong loops";
    if (const auto precision = evaluation.score.precision())
        std::cout << ", precision " << *precision;
    if (const auto recall = evaluation.score.recall()) std::cout << ", recall " << *recall;
    for (const auto& [name, error] : evaluation.trajectories)
        std::cout << ", ATE of trajectory_" << name << " " << error.ate_rmse << " m";
    std::cout << "\n";
}

/** Said before the long work begins, not after it. */
void require_readable(const std::string& file)
{
    if (!std::ifstream(file)) throw std::runtime_error("cannot read " + file);
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
    if (request.truth) require_readable(request.truth->file);
    RawlogReader reader(request.rawlog, options.stream.input.max_entry_megabytes);
    LoopClosureStream stream(options.stream, request.rawlog);
    const OutputFolder folder(request.output);
    Gathered gathered(folder, options);
    MapBuilder builder(options.stream.detector, options.graph);
    auto& summary = gathered.summary;
    summary.ended_early = read_what_can_be_read(request, reader, stream, builder, gathered);
    summary.clock_jumps = stream.detector().clock_jumps();
    summary.scaled_frames = stream.frames().scaled_frames();
    summary.ignored_camera_labels = stream.frames().ignored_camera_labels();
    RunOutput output(request, folder, stream, gathered);
    output.write_results(builder);
    output.attempt("cannot report the result",
                   [&]
                   {
                       print_result(summary, stream.frames().first_missing_image(), request.output);
                       if (output.truth()) print_evaluation(output.truth()->evaluation);
                       require_printed();
                   });
    output.write_summary_and_report(start);
    if (!summary.ended_early.empty())
        throw std::runtime_error(summary.ended_early + "; the results of the " +
                                 std::to_string(summary.camera_frames) + " frames before are in " +
                                 request.output);
}

}  // namespace fild
