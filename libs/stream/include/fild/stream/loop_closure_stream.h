// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/loop_detector.h"
#include "fild/detector/loop_poses.h"
#include "fild/places/place_map.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/input_options.h"
#include "fild/rawlog/paired_observations.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace fild
{
/** Options of a LoopClosureStream: the sections [input] to [runtime] of an .ini file. */
struct TLoopClosureStreamOptions
{
    TInputOptions input;
    TDetectorOptions detector;

    /** The sections by name; for load_sections(). */
    std::vector<std::pair<std::string, Options*>> sections();
};

/** The options of a stream out of an .ini file of rawlog-loop-closure, such as those in config-ini;
 *  sections for that app alone ([graph], [render], [report]) are passed over.
 *  \param overrides  as apply_overrides() takes them.
 *  \throw std::runtime_error as load_ini_file() and load_sections().
 *  \throw std::invalid_argument as apply_overrides(). */
TLoopClosureStreamOptions load_stream_options(const std::string& ini_path,
                                              const std::vector<std::string>& overrides = {});

/** What came of a camera frame. */
struct FedFrame
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    /** The frames whose verdict can now be given, oldest first. Without [consistency]
     *  look_ahead_seconds this frame, and no other. */
    std::vector<DetectorOutcome> decided{};
};

/** Finds loop closures in a stream of MRPT observations, fed one by one as on a robot.
 *  \code
 *  fild::LoopClosureStream stream(fild::load_stream_options("default.ini"));
 *  for (auto fed = stream.feed(*observation); fed; fed = stream.next())
 *      for (const auto& outcome : fed->decided)
 *          if (outcome.verdict.accepted())
 *              std::cout << "back at frame " << to_index(outcome.verdict.candidate->frame) << "\n";
 *  \endcode
 *  The images of two cameras that are a stereo pair become one frame when both are there, see
 *  StereoPairing.
 *  With [relative_pose] enabled, and as far as the recording has depth, an accepted loop has its
 *  metric pose (DetectorOutcome::pose).
 *  Deterministic: the same observations and options give the same verdicts, with any num_threads.
 *  With Backend::opencv OpenCV's own threads change the last digits of the global descriptor (see
 *  GlobalDescriptorExtractor): a program that wants the verdicts of rawlog-loop-closure, or the
 *  same ones on computers with more or fewer cores, calls cv::setNumThreads(1) before. Not
 *  thread-safe: one caller at a time. */
class LoopClosureStream
{
 public:
    /** \param rawlog_path  the rawlog that the observations come from, when there is one:
     * externally stored images are looked for beside it, see TInputOptions::images_dir. \throw
     * std::runtime_error when the model is missing or unfit, std::invalid_argument on bad options.
     */
    explicit LoopClosureStream(const TLoopClosureStreamOptions& options,
                               const std::string& rawlog_path = "");
    LoopClosureStream(const LoopClosureStream&) = delete;
    LoopClosureStream& operator=(const LoopClosureStream&) = delete;

    /** Takes one observation, and looks at the first frame that is then complete. Nothing comes
     *  back for observations that are not of the wanted camera, and while an image waits for its
     *  partner; every camera frame gets a verdict, in order.
     *  \throw std::runtime_error as FrameBuilder::build and StereoPairing::feed. */
    std::optional<FedFrame> feed(const mrpt::obs::CObservation& observation);

    /** Looks at the next complete frame, if there is one: an observation can complete several. */
    std::optional<FedFrame> next();

    /** At the end of the recording, until nothing comes back: as next(), with the images that still
     *  wait for a partner. */
    std::optional<FedFrame> drain();

    /** After drain(): the verdicts that still wait for later frames. */
    std::vector<DetectorOutcome> finish();

    const StereoPairing& pairing() const { return observations_.pairing(); }
    const FrameBuilder& frames() const { return frames_; }
    const LoopDetector& detector() const { return detector_; }
    /** What is kept of every frame that could be used. */
    const PlaceMap& places() const { return places_; }
    /** Memory of the places and their descriptors; the links of the HNSW graph (about
     *  8 x links_per_node bytes a frame) not counted. */
    std::size_t map_bytes() const { return places_.bytes() + detector_.descriptor_bytes(); }
    const StageTimes& times() const { return times_; }

 private:
    std::optional<FedFrame> look_at(const mrpt::obs::CObservation& observation);
    std::vector<DetectorOutcome> with_poses(std::vector<DetectorOutcome> outcomes);

    PairedObservations observations_;
    FrameBuilder frames_;
    FrameDescriber describer_;
    PlaceMap places_;
    LoopDetector detector_;
    LoopPoses poses_;
    StageTimes times_;
};

}  // namespace fild
