// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/loop_closure_run.h"

#include "fild/core/words.h"
#include "fild/job/error_line.h"
#include "fild/job/interruption.h"
#include "fild/job/output_folder.h"
#include "fild/job/progress_line.h"
#include "fild/job/standard_streams.h"
#include "fild/mapping/map_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "frame_notes.h"
#include "run_output.h"
#include "run_record.h"

#include <mrpt/obs/CObservation.h>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
/** What a run feeds, and where the answers go. */
struct Pass
{
    LoopClosureStream& stream;
    MapBuilder& map;
    RunRecord& record;
};

void take(const std::vector<DetectorOutcome>& outcomes, const Pass& pass)
{
    for (const auto& outcome : outcomes)
    {
        pass.record.add(outcome);
        pass.map.add(outcome);
    }
}

/** Where a run is in its rawlog. */
struct Progress
{
    const RunRequest& request;
    ProgressLine line;
    std::size_t frames = 0;

    bool is_done() const { return frames == request.max_frames && frames != 0; }
};

/** Takes the frames that `more` gives, up to the limit of frames. */
template <class More>
void take_frames(std::optional<FedFrame> fed,
                 const More& more,
                 double fraction_read,
                 Progress& progress,
                 const Pass& pass)
{
    for (; fed; fed = more())
    {
        ++progress.frames;
        pass.map.add_frame(fed->frame, fed->timestamp);
        pass.record.journal.add_costs(fed->frame, pass.stream);
        take(fed->decided, pass);
        const auto limit = progress.request.max_frames;
        const double of_limit =
            limit == 0 ? 0 : static_cast<double>(progress.frames) / static_cast<double>(limit);
        progress.line.update(
            std::max(fraction_read, of_limit), progress.frames, pass.record.summary.loop_closures);
        if (progress.is_done()) return;
        throw_if_interrupted();
    }
}

/** Feeds the rawlog to the stream until its end, the limit of frames or an interruption. */
void read_frames(RawlogReader& reader, Progress& progress, const Pass& pass)
{
    while (!progress.is_done())
    {
        throw_if_interrupted();
        const auto [observation, actions] = reader.next_entry();
        if (!observation && !actions) return;
        if (actions) pass.map.feed(*actions);
        if (!observation) continue;
        pass.map.feed(*observation);
        take_frames(
            pass.stream.feed(*observation),
            [&] { return pass.stream.next(); },
            reader.fraction_read(),
            progress,
            pass);
    }
}

/** As read_frames(), then the frames that wait for a partner: damage ends the recording too. */
void read_all_frames(RawlogReader& reader, Progress& progress, const Pass& pass)
{
    const auto drain = [&]
    {
        const auto more = [&] { return pass.stream.drain(); };
        if (!progress.is_done()) take_frames(more(), more, 1, progress, pass);
    };
    try
    {
        read_frames(reader, progress, pass);
    }
    catch (const TruncatedRawlog&)
    {
        drain();
        throw;
    }
    drain();
}

/** \return what the step throws, as one line; empty: nothing. */
std::string error_of(const std::function<void()>& step)
{
    try
    {
        step();
    }
    catch (const std::exception& error)
    {
        return error_line(error);
    }
    return "";
}

/** As read_all_frames(), then gives the verdicts that wait. An error after the first frame is
 *  returned: what came before is good. */
std::string read_what_can_be_read(const RunRequest& request, RawlogReader& reader, const Pass& pass)
{
    Progress progress{request, {request.quiet, "loop closures"}};
    auto ended_early = error_of([&] { read_all_frames(reader, progress, pass); });
    const auto error_at_end = error_of([&] { take(pass.stream.finish(), pass); });
    if (ended_early.empty()) ended_early = error_at_end;
    const auto& summary = pass.record.summary;
    const auto& frames = pass.stream.frames();
    if (summary.camera_frames > 0)
        return ended_early.empty() ? too_few_usable_frames(summary, frames) : ended_early;
    if (!ended_early.empty()) throw std::runtime_error(ended_early);
    const auto& label = request.options.stream.input.sensor_label;
    const auto wanted = label.empty() ? "" : " that matches [input] sensor_label='" + label + "'";
    throw std::runtime_error(request.rawlog + " has no camera observation" + wanted + "; " +
                             frames.describe_labels());
}

std::optional<PairSummary> summary_of(const std::optional<StereoPairReport>& pair)
{
    if (!pair) return std::nullopt;
    const auto& labels = pair->labels;
    return PairSummary{
        labels.left, labels.right, pair->paired, pair->left_alone, pair->right_alone};
}

void print_result(const RunSummary& summary, const std::string& output)
{
    for (const auto& note : summary.frame_notes) std::cerr << "note: " << note << "\n";
    if (summary.ended_early.empty())  // else one line says why
        for (const auto& note : summary.map.notes) std::cerr << "note: " << note << "\n";
    std::cout << count_of(summary.camera_frames, "frame") << ", "
              << count_of(summary.loop_closures, "loop closure") << ", in " << output << "\n";
    for (const auto& [rejection, count] : summary.frames_by_rejection)
        if (rejection != Rejection::none)
            std::cout << "  " << to_word(rejection) << ": " << count << " ("
                      << meaning_of(rejection) << ")\n";
    if (summary.map.nodes > 0)
        std::cout << "map: " << count_of(summary.map.nodes, "keyframe") << ", "
                  << count_of(summary.map.loop_edges, "loop edge") << "\n";
}

/** The protocol's own words, then the score, then where the single loops are: the rest is in the
 *  report. */
void print_evaluation(const ReportTruth& truth, const std::string& output)
{
    const auto& [protocol, evaluation] = std::tie(truth.description.protocol, truth.evaluation);
    const auto& score = evaluation.score;
    std::cout << std::fixed << std::setprecision(3) << "against the ground truth ("
              << to_word(protocol) << "): " << score.right << " right, " << score.wrong_loops.size()
              << " wrong, " << score.neither << " doubtful, " << score.missed() << " missed";
    if (const auto precision = score.precision()) std::cout << ", precision " << *precision;
    if (const auto recall = score.recall()) std::cout << ", recall " << *recall;
    for (const auto& [name, error] : evaluation.trajectories)
        std::cout << ", ATE of trajectory_" << name << " " << error.ate_rmse << " m";
    std::cout << "\n";
    if (!score.wrong_loops.empty())
        std::cout << "  wrong loops, with their pictures: " << output << "/wrong_loops.csv\n";
    if (score.missed() > 0 && evaluation.candidates)
        std::cout << "  missed loops, with the stage that lost them: " << output
                  << "/missed_loops.csv\n";
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
    say_on_terminal(request.quiet, "reading the network");
    LoopClosureStream stream(options.stream, request.rawlog);
    const OutputFolder folder(request.output);
    RunRecord record(folder, options);
    MapBuilder builder(options.stream.detector, options.graph);
    auto& summary = record.summary;
    summary.ended_early = read_what_can_be_read(request, reader, {stream, builder, record});
    summary.clock_jumps = stream.detector().clock_jumps();
    summary.scaled_frames = stream.frames().scaled_frames();
    summary.ignored_camera_labels = stream.frames().ignored_camera_labels();
    summary.stereo_pair = summary_of(stream.pairing().report());
    summary.frame_notes = notes_on_frames(record, stream, options.stream.detector.index);
    RunOutput output(request, folder, stream, record);
    say_on_terminal(request.quiet, "making the map and the pictures");
    output.write_results(builder);
    output.attempt({"cannot report the result"},
                   [&]
                   {
                       print_result(summary, request.output);
                       if (output.truth()) print_evaluation(*output.truth(), request.output);
                       require_printed();
                   });
    output.write_summary_and_report(start);
    if (!summary.ended_early.empty())
        throw std::runtime_error(summary.ended_early + "; the results of the " +
                                 count_of(summary.camera_frames, "frame") + " before are in " +
                                 request.output);
    if (options.report.write_html)
        std::cout << "look at " << request.output << "/report.html in a browser\n";
}

}  // namespace fild
