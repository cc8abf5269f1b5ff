// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/sweep.h"

#include "fild/core/parallel_for.h"
#include "fild/core/words.h"
#include "fild/detector/loop_detector.h"
#include "fild/job/interruption.h"
#include "fild/job/progress_line.h"
#include "fild/job/wrong_usage.h"
#include "fild/rawlog/frame_reader.h"
#include "fild/stream/loop_closure_stream.h"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
/** One run: a point of the sweep with one seed. */
struct Run
{
    TLoopClosureStreamOptions options;
    std::optional<RunEvaluation> evaluation;  ///< none: not done
    StageTimes times;
};

/** The features of all frames; what they depend on is in the key. */
struct Recording
{
    std::vector<FrameFeatures> frames;
    std::size_t global_dimension = 0;
    std::string first_missing_image;  ///< empty: none was missing
    std::size_t scaled_frames = 0;  ///< to the size of their camera's first image
};

/** A choice of values, as it stands in the table and as it is put into force. */
struct Choice
{
    std::vector<std::string> values;  ///< one for each key of the report
    std::vector<std::string> overrides;
};

std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

std::vector<Choice> choices_of(const SweepRequest& request)
{
    std::vector<Choice> choices;
    if (!request.changes.empty()) choices.push_back({{"(nothing)"}, {}});
    for (const auto& change : request.changes) choices.push_back({{change}, words_of(change)});
    if (!request.changes.empty()) return choices;
    for (const auto& values : combinations_of(request.keys))
    {
        auto& choice = choices.emplace_back(Choice{values, {}});
        for (std::size_t i = 0; i < values.size(); ++i)
            choice.overrides.push_back(request.keys[i].key + "=" + values[i]);
    }
    return choices;
}

TLoopClosureStreamOptions options_of_run(const SweepRequest& request,
                                         const Choice& choice,
                                         std::optional<int> seed)
{
    auto overrides = request.overrides;
    overrides.insert(overrides.end(), choice.overrides.begin(), choice.overrides.end());
    if (seed) overrides.push_back("runtime.seed=" + std::to_string(*seed));
    return load_stream_options(request.config, overrides);
}

/** What descriptors and keypoints depend on, as text. */
std::string feature_key_of(TLoopClosureStreamOptions& options)
{
    std::string key;
    for (const Options* section : std::initializer_list<const Options*>{
             &options.input, &options.detector.global_descriptor, &options.detector.local_features})
        for (const auto& [name, value] : section->values())
            key.append(name).append("=").append(value).append("\n");
    return key;
}

/** Hands the reader to `use` at every frame until the end of the rawlog, the limit of frames or an
 *  interruption, with the share of the work that is done. */
template <class Use>
void for_each_frame(const SweepRequest& request, FrameReader& reader, const Use& use)
{
    std::size_t frames = 0;
    while ((frames < request.max_frames || request.max_frames == 0) && !interrupted())
    {
        if (!reader.next()) return;
        ++frames;
        const double of_limit =
            request.max_frames == 0
                ? 0
                : static_cast<double>(frames) / static_cast<double>(request.max_frames);
        use(std::max(reader.fraction_read(), of_limit));
    }
}

/** Which frames the rawlog has, for the ground truth: reads none of their images but the first. */
std::vector<FrameVerdict> frames_of(const SweepRequest& request, const TInputOptions& input)
{
    FrameReader reader(request.rawlog, input);
    std::vector<FrameVerdict> frames;
    for_each_frame(request,
                   reader,
                   [&](double)
                   {
                       const auto skipped = reader.skip();
                       FrameVerdict frame;
                       frame.frame = skipped.id;
                       frame.timestamp = skipped.timestamp;
                       frame.sensor_label = skipped.sensor_label;
                       frames.push_back(frame);
                   });
    throw_if_interrupted();
    if (frames.empty())
        throw std::runtime_error(request.rawlog +
                                 " has no camera observation of the wanted camera; " +
                                 reader.builder().describe_labels());
    return frames;
}

Recording extract_features(const SweepRequest& request, TLoopClosureStreamOptions options)
{
    options.detector.runtime.num_threads = request.jobs;
    FrameReader reader(request.rawlog, options.input);
    FrameFeatureExtractor extractor(options.detector);
    Recording recording{{}, extractor.global_dimension(), {}, 0};
    StageTimes times;
    std::size_t keypoints = 0;
    ProgressLine progress(request.quiet, "keypoints");
    for_each_frame(request,
                   reader,
                   [&](double fraction)
                   {
                       recording.frames.push_back(extractor.extract(reader.build(), times));
                       keypoints += recording.frames.back().local.size();
                       progress.update(fraction, recording.frames.size(), keypoints);
                   });
    recording.first_missing_image = reader.builder().first_missing_image();
    recording.scaled_frames = reader.builder().scaled_frames();
    return recording;
}

/** What the user should know of frames that were scaled or could not be used.
 *  \throw std::runtime_error when none could. */
std::vector<std::string> remarks_on(const Recording& recording)
{
    const auto is_unusable = [](const FrameFeatures& frame)
    { return frame.defect != Rejection::none; };
    const auto unusable =
        std::count_if(recording.frames.begin(), recording.frames.end(), is_unusable);
    std::vector<std::string> remarks;
    if (recording.scaled_frames > 0)
        remarks.push_back(count_of(recording.scaled_frames, "image was", "images were") +
                          " scaled to the size of their camera's first image");
    if (unusable == 0) return remarks;
    auto remark = std::to_string(unusable) + " of " + count_of(recording.frames.size(), "frame") +
                  " could not be used";
    if (!recording.first_missing_image.empty())
        remark += "; the first image that is missing is " + recording.first_missing_image +
                  ", set [input] images_dir to the folder of the images";
    if (static_cast<std::size_t>(unusable) == recording.frames.size() && !interrupted())
        throw std::runtime_error(remark);
    remarks.push_back(remark);
    return remarks;
}

FrameDescription hash(const FrameHasher& hasher, const FrameFeatures& features, StageTimes& times)
{
    const StageTimer timer(times, "hashing");
    return hasher.hash(features);
}

/** The detector over the whole recording; nothing when it was interrupted.
 *  \param on_frame  called after every frame. */
std::optional<RunResults> detect(const Recording& recording,
                                 TDetectorOptions options,
                                 StageTimes& times,
                                 const std::function<void()>& on_frame)
{
    options.runtime.num_threads = 1;  // the runs themselves are side by side
    const FrameHasher hasher(options);
    PlaceMap places;
    LoopDetector detector(options, recording.global_dimension, places);
    RunResults results;
    results.answers.emplace();
    const auto add = [&](std::vector<DetectorOutcome> outcomes)
    {
        for (auto& outcome : outcomes)
        {
            results.frames.push_back(std::move(outcome.verdict));
            results.answers->push_back(std::move(outcome.considered));
        }
    };
    for (const auto& features : recording.frames)
    {
        if (interrupted()) return std::nullopt;
        add(detector.process(hash(hasher, features, times), times));
        on_frame();
    }
    add(detector.finish(times));
    return results;
}

/** Runs that share a recording, side by side. */
void evaluate_runs(const SweepRequest& request,
                   const Recording& recording,
                   const LoopTruth& truth,
                   const std::vector<Run*>& runs)
{
    ProgressLine progress(request.quiet, "of " + std::to_string(runs.size()) + " runs");
    std::mutex mutex;  // of the progress line and its counts
    std::size_t frames = 0;
    std::size_t done = 0;
    const auto all_frames = static_cast<double>(runs.size() * recording.frames.size());
    const auto count_frame = [&]
    {
        const std::lock_guard lock(mutex);
        ++frames;
        progress.update(static_cast<double>(frames) / all_frames, frames, done);
    };
    const auto evaluate_run = [&](std::size_t i)
    {
        auto& run = *runs[i];
        const auto results = detect(recording, run.options.detector, run.times, count_frame);
        if (!results) return;
        run.evaluation = evaluate_loops(*results, truth);
        const std::lock_guard lock(mutex);
        ++done;
    };
    parallel_for(request.jobs, runs.size(), evaluate_run);
}

/** All points are held to one least age of a candidate, so that their scores compare. */
double longest_delay(const std::vector<std::vector<Run>>& points)
{
    double longest = 0;
    for (const auto& runs : points)
        for (const auto& run : runs)
            longest = std::max(longest, run.options.detector.index.delay_seconds);
    return longest;
}

/** Of each point, the runs with each of the seeds. */
std::vector<std::vector<Run>> plan(const SweepRequest& request, const std::vector<Choice>& choices)
{
    std::vector<std::vector<Run>> points;
    for (const auto& choice : choices)
    {
        auto& runs = points.emplace_back();
        for (const int seed : request.seeds)
            runs.push_back({options_of_run(request, choice, seed), {}, {}});
        if (request.seeds.empty())
            runs.push_back({options_of_run(request, choice, std::nullopt), {}, {}});
    }
    return points;
}

/** The runs in groups of equal features, in the order of the first of each. */
std::vector<std::vector<Run*>> group_by_features(std::vector<std::vector<Run>>& points)
{
    std::vector<std::pair<std::string, std::vector<Run*>>> groups;
    for (auto& point : points)
        for (auto& run : point)
        {
            const auto key = feature_key_of(run.options);
            auto group = std::find_if(groups.begin(),
                                      groups.end(),
                                      [&](const auto& other) { return other.first == key; });
            if (group == groups.end()) group = groups.insert(group, {key, {}});
            group->second.push_back(&run);
        }
    std::vector<std::vector<Run*>> runs;
    runs.reserve(groups.size());
    for (auto& group : groups) runs.push_back(std::move(group.second));
    return runs;
}

/** Takes over the runs of each point that is complete. */
void collect(std::vector<std::vector<Run>>& points,
             const std::vector<Choice>& choices,
             SweepReport& report)
{
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto is_done = [](const Run& run) { return run.evaluation.has_value(); };
        if (!std::all_of(points[i].begin(), points[i].end(), is_done)) continue;
        auto& point = report.points.emplace_back();
        point.values = choices[i].values;
        for (auto& run : points[i])
        {
            point.runs.push_back(std::move(*run.evaluation));
            point.seeds.push_back(run.options.detector.runtime.seed);
            point.times.merge(run.times);
        }
    }
    if (report.points.size() < points.size())
        report.ended_early = "interrupted after " + std::to_string(report.points.size()) + " of " +
                             std::to_string(points.size()) + " points";
}

/** \throw WrongUsage unless the detector has the section, or for the seed. */
void require_sweepable(const std::string& key)
{
    TLoopClosureStreamOptions options;
    const auto section = key.substr(0, key.find('.'));
    if (key == "runtime.seed") throw WrongUsage("runtime.seed is swept by --seeds");
    std::string known;
    for (const auto& [name, ignored] : options.sections())
    {
        if (name == section) return;
        known.append(" [").append(name).append("]");
    }
    throw WrongUsage("no loop closure depends on " + key + "; sections:" + known);
}

void require_sweepable(const SweepRequest& request)
{
    for (const auto& swept : request.keys)
    {
        require_sweepable(swept.key);
        const auto is_same = [&](const SweptKey& other) { return other.key == swept.key; };
        if (std::count_if(request.keys.begin(), request.keys.end(), is_same) > 1)
            throw WrongUsage(swept.key + " is swept twice");
    }
    for (const auto& change : request.changes)
    {
        const auto words = words_of(change);
        if (words.empty()) throw WrongUsage("an empty --change changes nothing");
        for (const auto& word : words) require_sweepable(word.substr(0, word.find('=')));
    }
}
}  // namespace

SweepReport sweep(const SweepRequest& request)
{
    require_sweepable(request);
    catch_interruption();
    cv::setNumThreads(1);  // the runs are side by side
    const auto choices = choices_of(request);
    auto points = plan(request, choices);
    SweepReport report;
    report.rawlog = request.rawlog;
    report.config = request.config;
    report.overrides = request.overrides;
    for (const auto& swept : request.keys) report.keys.push_back(swept.key);
    if (!request.changes.empty()) report.keys = {"changed"};
    for (const auto& runs : group_by_features(points))
    {
        const auto& options = runs.front()->options;
        const auto of_runs = for_run(request.truth, longest_delay(points));
        const auto truth = load_truth(of_runs, frames_of(request, options.input));
        report.truth = {of_runs.file, truth.content, truth.remarks, of_runs.protocol};
        const auto recording = extract_features(request, options);
        report.remarks = remarks_on(recording);
        evaluate_runs(request, recording, *truth.truth, runs);
    }
    collect(points, choices, report);
    return report;
}

}  // namespace fild
