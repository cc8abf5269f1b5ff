// SPDX-License-Identifier: BSD-3-Clause
#include "fild/stream/loop_closure_stream.h"

#include "fild/core/ini_file.h"

#include <mrpt/obs/CObservation.h>

namespace fild
{
std::vector<std::pair<std::string, Options*>> TLoopClosureStreamOptions::sections()
{
    std::vector<std::pair<std::string, Options*>> all = {{"input", &input}};
    for (const auto& section : detector.sections()) all.push_back(section);
    return all;
}

TLoopClosureStreamOptions load_stream_options(const std::string& ini_path,
                                              const std::vector<std::string>& overrides)
{
    TLoopClosureStreamOptions options;
    auto ini = load_ini_file(ini_path);
    apply_overrides(ini, overrides);
    load_sections(ini, options.sections(), {"graph", "render", "report"});
    return options;
}

LoopClosureStream::LoopClosureStream(const TLoopClosureStreamOptions& options,
                                     const std::string& rawlog_path)
    : observations_(options.input),
      frames_(options.input,
              rawlog_path,
              options.detector.relative_pose.enabled ? FrameContent::metric : FrameContent::image),
      describer_(options.detector),
      detector_(options.detector, describer_.global_dimension(), places_),
      poses_(options.detector)
{
}

std::optional<FedFrame> LoopClosureStream::feed(const mrpt::obs::CObservation& observation)
{
    if (observations_.feed(observation)) return next();
    if (observations_.empty()) return look_at(observation);
    observations_.append(
        std::dynamic_pointer_cast<mrpt::obs::CObservation>(observation.duplicateGetSmartPtr()));
    return next();
}

std::optional<FedFrame> LoopClosureStream::next()
{
    while (const auto observation = observations_.take())
        if (auto fed = look_at(*observation)) return fed;
    return std::nullopt;
}

std::optional<FedFrame> LoopClosureStream::drain()
{
    observations_.finish();
    return next();
}

std::optional<FedFrame> LoopClosureStream::look_at(const mrpt::obs::CObservation& observation)
{
    if (!frames_.accepts(observation)) return std::nullopt;
    const StageTimer whole(times_, "whole_frame");
    Frame frame;
    {
        const StageTimer timer(times_, "image_decoding");
        frame = frames_.build(observation);
    }
    auto decided = detector_.process(describer_.describe(frame, times_), times_);
    return FedFrame{frame.id, frame.timestamp, with_poses(std::move(decided))};
}

std::vector<DetectorOutcome> LoopClosureStream::finish()
{
    return with_poses(detector_.finish(times_));
}

std::vector<DetectorOutcome> LoopClosureStream::with_poses(std::vector<DetectorOutcome> outcomes)
{
    for (auto& outcome : outcomes) poses_.add_pose(outcome, places_, times_);
    return outcomes;
}

}  // namespace fild
