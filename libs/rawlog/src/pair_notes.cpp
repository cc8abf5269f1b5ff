// SPDX-License-Identifier: BSD-3-Clause
#include "pair_notes.h"

#include "fild/core/number_text.h"
#include "fild/core/words.h"

#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace fild
{
namespace
{
constexpr const char* kWithoutPairs = "or set stereo_labels = none to use one camera";

/** To a thousandth, without zeros at the end. */
std::string seconds_text(double seconds)
{
    return shortest_decimal(std::round(seconds * 1000) / 1000);
}

std::string of_both(const StereoLabels& labels)
{
    return "'" + labels.left + "' and '" + labels.right + "'";
}

/** What helps when images are further apart than the tolerance. */
std::string advice_on(double difference, std::optional<double> largest)
{
    const double enough = std::ceil(1200 * difference) / 1000;
    if (largest && enough > *largest)
        return "the cameras do not record at the same moments: set [input] stereo_labels = none";
    return "set [input] stereo_tolerance_seconds = " + seconds_text(enough) + ", " + kWithoutPairs;
}

std::string no_calibration_note(const StereoLabels& labels, const std::string& uncalibrated)
{
    return "camera '" + uncalibrated + "' is not calibrated, so " + of_both(labels) +
           " give no depth; put its calibration into the rawlog, or set [input] camera_parameters "
           "if it is the same for both";
}

std::string same_place_note(const StereoLabels& labels)
{
    return "by their poses on the robot cameras " + of_both(labels) +
           " are in one place (a baseline of 0), so they give no depth; put the poses into the "
           "rawlog (rawlog-edit --sensors-pose)";
}

std::string apart_note(const StereoLabels& labels)
{
    return "by their poses on the robot cameras " + of_both(labels) +
           " do not look the same way from beside each other; correct the poses in the rawlog, " +
           kWithoutPairs;
}

std::string missing_note(const StereoLabels& labels)
{
    return "[input] stereo_labels names camera '" + labels.right +
           "', of which the rawlog has no image; correct the name, " + kWithoutPairs;
}

std::string right_stops_note(const PairedCameras& pair)
{
    const auto& partners = pair.partners;
    return "camera '" + pair.labels.right + "' ends " +
           seconds_text(*partners.last_left() - *partners.last_right()) + " s before '" +
           pair.labels.left + "': the last " + count_of(partners.left_since_pair(), "frame") +
           " have no right image, and so no depth of their own; --max-frames ends the run before";
}

std::string left_stops_note(const PairedCameras& pair)
{
    const auto& partners = pair.partners;
    return "camera '" + pair.labels.left + "' ends " +
           seconds_text(*partners.last_right() - *partners.last_left()) + " s before '" +
           pair.labels.right + "': " + count_of(partners.right_since_pair(), "image") +
           " of that are in no frame; to look at them, set [input] sensor_label = " +
           pair.labels.right + " and stereo_labels = none";
}

std::string few_partners_note(const PairedCameras& pair, double tolerance_seconds)
{
    const auto& partners = pair.partners;
    auto note = "only " + std::to_string(partners.paired()) + " of " +
                count_of(partners.paired() + partners.left_alone(), "image") + " of camera '" +
                pair.labels.left + "' have one of '" + pair.labels.right + "' within " +
                seconds_text(tolerance_seconds) + " s";
    const auto miss = partners.usual_miss();
    if (!miss) return note;
    return note + ", the others are usually " + seconds_text(*miss) + " s apart; " +
           advice_on(*miss, partners.largest_tolerance());
}

bool is_in_time(const PairCandidates::Trial& trial, double tolerance_seconds)
{
    const auto difference = usual_difference(trial);
    return difference && *difference <= tolerance_seconds;
}

std::optional<std::string> note_on_trial(const StereoLabels& labels,
                                         const PairCandidates::Trial& trial,
                                         double tolerance_seconds)
{
    const bool is_near = is_in_time(trial, tolerance_seconds);
    if (trial.fit == PairFit::not_calibrated && is_near)
        return no_calibration_note(labels, trial.without_calibration);
    if (trial.fit == PairFit::same_place && is_near) return same_place_note(labels);
    constexpr std::size_t kEnough = 8;
    const bool is_pair =
        trial.fit == PairFit::first_is_left || trial.fit == PairFit::second_is_left;
    if (!is_pair || is_near || trial.differences.size() < kEnough) return std::nullopt;
    const double difference = *usual_difference(trial);
    return "cameras " + of_both(labels) + " could be a stereo pair, but their images are usually " +
           seconds_text(difference) + " s apart, more than [input] stereo_tolerance_seconds = " +
           seconds_text(tolerance_seconds) + "; " + advice_on(difference, std::nullopt);
}
}  // namespace

std::vector<StereoPairNote> notes_on_pair(const PairedCameras& pair, double tolerance_seconds)
{
    constexpr std::size_t kStopped = 10;
    const auto& [labels, partners] = std::tie(pair.labels, pair.partners);
    const auto note = [&](const std::string& text) {
        return std::vector<StereoPairNote>{{pair.labels.right, text}};
    };
    if (!pair.has_right) return note(missing_note(labels));
    if (pair.fit == PairFit::not_calibrated)
        return note(no_calibration_note(labels, pair.without_calibration));
    if (pair.fit == PairFit::same_place) return note(same_place_note(labels));
    if (pair.fit == PairFit::apart) return note(apart_note(labels));
    const bool has_pairs = partners.paired() > 0;
    if (has_pairs && partners.left_since_pair() >= kStopped && partners.right_since_pair() == 0)
        return note(right_stops_note(pair));
    if (has_pairs && partners.right_since_pair() >= kStopped && partners.left_since_pair() == 0)
        return note(left_stops_note(pair));
    if (partners.left_alone() >= kStopped && partners.left_alone() > partners.paired())
        return note(few_partners_note(pair, tolerance_seconds));
    return {};
}

std::vector<StereoPairNote> notes_on_trials(
    const PairCandidates::Trials& trials,
    double tolerance_seconds,
    const std::function<bool(const std::string&)>& could_be_left)
{
    std::vector<StereoPairNote> notes;
    for (const auto& [names, trial] : trials)
    {
        StereoLabels labels{names.first, names.second};
        const bool is_second_left =
            trial.fit == PairFit::second_is_left ||
            (trial.fit != PairFit::first_is_left && !could_be_left(labels.left));
        if (is_second_left) std::swap(labels.left, labels.right);
        if (!could_be_left(labels.left)) continue;
        if (const auto text = note_on_trial(labels, trial, tolerance_seconds))
            notes.push_back({labels.right, *text});
    }
    return notes;
}

}  // namespace fild
