// SPDX-License-Identifier: BSD-3-Clause
#include "frame_notes.h"

#include "fild/core/words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace fild
{
namespace
{
/** "59 repeated_timestamp, 1 missing_image", of those that were passed over. */
std::string unusable_by_reason(const RunSummary& summary)
{
    std::string text;
    for (const auto& [rejection, count] : summary.frames_by_rejection)
        if (is_unusable(rejection))
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + to_word(rejection);
    return text;
}

std::size_t frames_with(Rejection rejection, const RunSummary& summary)
{
    const auto found = summary.frames_by_rejection.find(rejection);
    return found == summary.frames_by_rejection.end() ? 0 : found->second;
}

/** Seconds from the earliest to the latest time stamp. */
double recorded_seconds(const std::vector<FrameVerdict>& verdicts)
{
    const auto [first, last] = std::minmax_element(verdicts.begin(),
                                                   verdicts.end(),
                                                   [](const FrameVerdict& a, const FrameVerdict& b)
                                                   { return a.timestamp < b.timestamp; });
    return last->timestamp - first->timestamp;
}

std::string whole(double number)
{
    return std::to_string(std::llround(number));
}

/** Why all frames are too_early, and what helps. */
std::string why_all_are_early(const std::vector<FrameVerdict>& verdicts, const TIndexOptions& delay)
{
    const std::string none = "no frame could be compared with an earlier one: ";
    if (delay.frame_rate > 0)
        return none + "there are not more frames than [index] delay_seconds x frame_rate = " +
               whole(delay.delay_seconds * delay.frame_rate);
    const double seconds = recorded_seconds(verdicts);
    const std::string by_frames =
        "set [index] frame_rate, and the delay is counted in frames, whatever the time stamps say";
    if (seconds == 0) return none + "their time stamps are missing or all the same; " + by_frames;
    if (seconds > delay.delay_seconds) return none + "their time stamps jump; " + by_frames;
    return none + "their time stamps span " + whole(seconds) +
           " s, and candidates are at least [index] delay_seconds = " + whole(delay.delay_seconds) +
           " s old; set it to less, or, where the time stamps are "
           "wrong, set [index] frame_rate";
}

/** A camera that has a note about its pair gets no second one. */
std::vector<std::string> notes_on_cameras(const RunSummary& summary, const StereoPairing& pairing)
{
    std::vector<std::string> notes;
    std::set<std::string> noted;
    for (const auto& [label, text] : pairing.notes())
    {
        notes.push_back(text);
        noted.insert(label);
    }
    for (const auto& label : summary.ignored_camera_labels)
        if (noted.count(label) == 0)
            notes.push_back("camera " + label +
                            " was not looked at; [input] sensor_label chooses cameras");
    return notes;
}

/** Frames by why they have no depths of their own. */
std::map<std::string, std::size_t> depth_defects_of(const PlaceMap& places, std::size_t frames)
{
    std::map<std::string, std::size_t> defects;
    for (std::size_t i = 0; i < frames; ++i)
        if (const auto* place = places.find(FrameId{i}))
            if (place->metric.depth_defect != DepthDefect::none)
                ++defects[to_word(place->metric.depth_defect)];
    return defects;
}

/** Stereo pairs and depth images that are there, and yet of little use; empty: they are of use.
 *  \param least  keypoints with a depth that a metric pose takes. */
std::string note_on_sparse_depths(const RunSummary& summary,
                                  const PlaceMap& places,
                                  std::size_t least)
{
    constexpr std::size_t kEnoughKeypoints = 100;
    constexpr std::size_t kEnoughFrames = 8;
    std::size_t looked_at = 0;
    std::size_t sparse = 0;
    for (std::size_t i = 0; i < summary.camera_frames; ++i)
    {
        const auto* place = places.find(FrameId{i});
        if (place == nullptr || place->metric.depth_defect != DepthDefect::none ||
            !place->metric.camera || place->local.positions.size() < kEnoughKeypoints)
            continue;
        ++looked_at;
        if (place->metric.depths.known() < least) ++sparse;
    }
    if (looked_at < kEnoughFrames || 2 * sparse < looked_at) return "";
    const auto& pair = summary.stereo_pair;
    const auto which = pair ? " of cameras '" + pair->left + "' and '" + pair->right + "'" : "";
    return std::to_string(sparse) + " of " + std::to_string(looked_at) +
           " frames have a depth for fewer than " + std::to_string(least) +
           " keypoints: are left and right image" + which +
           " swapped, or their calibration or poses wrong, or is all further away than [depth] "
           "max_relative_deviation allows?" +
           (pair ? " [input] stereo_labels = none takes one camera" : "");
}
}  // namespace

std::vector<std::string> notes_on_frames(const RunRecord& record,
                                         const LoopClosureStream& stream,
                                         const TIndexOptions& delay)
{
    const auto& summary = record.summary;
    const auto& frames = stream.frames();
    auto notes = notes_on_cameras(summary, stream.pairing());
    if (const auto missing = frames_with(Rejection::missing_image, summary); missing > 0)
        notes.push_back(count_of(missing, "image is", "images are") +
                        " missing or cannot be read, the first is " + frames.first_missing_image() +
                        "; [input] images_dir names their folder");
    if (summary.scaled_frames > 0)
        notes.push_back(count_of(summary.scaled_frames, "image was", "images were") +
                        " scaled to the size of their camera's first image");
    for (const auto& note : frames.calibration_notes()) notes.push_back(note);
    const auto usable = summary.usable_frames();
    if (usable > 1 && 2 * usable < summary.camera_frames)
        notes.push_back("only " + std::to_string(usable) + " of " +
                        std::to_string(summary.camera_frames) +
                        " frames could be used: " + unusable_by_reason(summary));
    const bool was_read_to_its_end = summary.ended_early.empty();
    if (was_read_to_its_end && usable > 1 && frames_with(Rejection::too_early, summary) == usable)
        notes.push_back(why_all_are_early(record.verdicts, delay));
    return notes;
}

std::string too_few_usable_frames(const RunSummary& summary, const FrameBuilder& frames)
{
    const auto usable = summary.usable_frames();
    if (usable > 1 || usable == summary.camera_frames) return "";
    auto reason = usable == 0 ? std::string("no frame could be used")
                              : "only one frame of " + std::to_string(summary.camera_frames) +
                                    " could be used";
    reason += " (" + unusable_by_reason(summary) + ")";
    if (const auto pixels = frames.first_unsupported_image(); !pixels.empty())
        reason += "; pixels must be grey or colour of 8 or 16 bit, not as in " + pixels;
    if (const auto missing = frames.first_missing_image(); !missing.empty())
        reason += "; the first image that is missing is " + missing +
                  "; set [input] images_dir to the folder of the images";
    return reason;
}

void add_notes_on_depths(RunSummary& summary,
                         const PlaceMap& places,
                         const TRelativePoseOptions& options)
{
    auto& map = summary.map;
    map.depth_defects = depth_defects_of(places, summary.camera_frames);
    for (const auto& [defect, count] : map.depth_defects)
        if (count == summary.camera_frames && defect != to_word(DepthDefect::mono) &&
            map.loops_withheld.count(defect) == 0)
            map.notes.push_back("no frame has a depth of its own: " + defect);
    if (!options.enabled) return;
    if (auto note =
            note_on_sparse_depths(summary, places, static_cast<std::size_t>(options.min_points));
        !note.empty())
        map.notes.push_back(std::move(note));
}

}  // namespace fild
