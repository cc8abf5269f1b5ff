// SPDX-License-Identifier: BSD-3-Clause
#include "map_notes.h"

#include "fild/core/angle.h"
#include "fild/core/words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace fild
{
namespace
{
using Notes = std::vector<std::string>;

/** Whole, or with two digits when it is less than 10; whatever the locale. */
std::string in_short(double number)
{
    if (number >= 10) return std::to_string(std::llround(number));
    std::array<char, 32> text{};
    const auto end = std::to_chars(
        text.data(), text.data() + text.size(), number, std::chars_format::general, 2);
    return {text.data(), end.ptr};
}

/** Sources of motion without a part in the map, and those that are less certain than they say. */
void add_notes_on_sources(const Map& map, Notes& notes)
{
    constexpr double kNotable = 3;
    if (!map.unused_sources.empty())
        notes.push_back("odometries that were not used: " + joined(map.unused_sources, ", ") +
                        "; [graph] motion_sensor_label chooses");
    for (const auto& source : map.sources)
    {
        if (!source.left_out.empty())
            notes.push_back(source.name + " has no part in the map: " + source.left_out);
        else if (source.noise_scale >= kNotable)
            notes.push_back(source.name + " was weighed down: its errors are " +
                            in_short(source.noise_scale) + " times as large as it says");
        if (source.kind == "gps" && 10 * source.without_weight > source.factors)
            notes.push_back(std::to_string(source.without_weight) + " of " +
                            count_of(source.factors, "position") + " by " + source.name +
                            " contradict the rest of the map and do not count");
    }
}

/** Readings that cannot be right. */
void add_notes_on_readings(const TrajectoryReport& recorded,
                           const TGraphOptions& options,
                           Notes& notes)
{
    const auto limit =
        "[graph] max_speed_m_per_s = " + in_short(options.max_speed_m_per_s) + " allows";
    if (recorded.fixes_without_gga > 0)
        notes.push_back(count_of(recorded.fixes_without_gga, "reading") + " of " + recorded.source +
                        " without a GGA message, the only one that is read (RMC and others are "
                        "not)");
    if (recorded.implausible_readings > 0)
        notes.push_back(std::to_string(recorded.implausible_readings) + " of " +
                        std::to_string(recorded.implausible_readings + recorded.readings) +
                        " fixes of " + recorded.source +
                        " were left out: they are further from the others than " + limit);
    if (recorded.resets > 0)
        notes.push_back(recorded.source + " was reset, or jumped further than " + limit + ", " +
                        count_of(recorded.resets, "time") + "; is it in metres?");
}

bool tells_no_movement(const Map& map)
{
    constexpr std::size_t kFrames = 10;
    constexpr double kWay = 0.05;  // m
    constexpr double kTurn = kRadiansPerDegree;
    const auto& poses = map.trajectory.poses();
    if (map.trajectory_source != TrajectorySource::recorded || poses.size() < kFrames) return false;
    for (const auto& pose : poses)
    {
        const auto motion = pose.map_from_robot - poses.front().map_from_robot;
        if (motion.norm() > kWay) return false;
        if (std::abs(motion.yaw()) > kTurn || std::abs(motion.pitch()) > kTurn ||
            std::abs(motion.roll()) > kTurn)
            return false;
    }
    return true;
}

/** What the images and the recorded motion say of each other. */
void add_notes_on_agreement(const Map& map, Notes& notes)
{
    const auto& agreement = map.agreement;
    const auto& source = map.compared_source;
    if (tells_no_movement(map))
        notes.push_back(source + " tells no movement from the first frame to the last");
    if (agreement.contradicts_directions())
        notes.push_back(
            "the images tell movements in other directions than " + source + ", " +
            in_short(agreement.direction_error_deg.median) + " degrees off; " +
            (agreement.lacks_turn()
                 ? "the camera's pose on the robot lacks the turn to the axes of a camera: yaw "
                   "-90, pitch 0, roll -90 degrees for one that looks ahead"
                 : "the camera's pose on the robot is wrong, or the images are mirrored or "
                   "turned"));
    if (agreement.contradicts_lengths())
        notes.push_back("movements by the depths of the images are " +
                        in_short(agreement.length_ratio.median) + " times as long as those by " +
                        source +
                        "; a wrong baseline, unit of the depth images or unit of the odometry does "
                        "that");
}

/** What the user should know of the loops that are no edges. */
void add_notes_on_loops(const MapSummary& summary, Notes& notes)
{
    const auto withheld = [&](Withheld reason)
    {
        const auto found = summary.loops_withheld.find(to_word(reason));
        return found == summary.loops_withheld.end() ? 0 : found->second;
    };
    const auto add = [&](std::size_t count, const std::string& why)
    {
        if (count > 0)
            notes.push_back(count_of(count, "loop closure") + " without an edge: " + why);
    };
    add(withheld(Withheld::not_calibrated),
        "the camera is not calibrated; [input] camera_parameters gives a calibration");
    add(withheld(Withheld::distorted), "lens distortion was left in; set [input] undistort = true");
    add(withheld(Withheld::no_odometry),
        "a single camera sees directions but no distances, and there is no odometry");
    add(withheld(Withheld::frame_without_pose), "nothing tells where the robot was at its frames");
}

/** What has its own note is left out. */
void add_note_on_most_loops(const Map& map, const MapSummary& summary, Notes& notes)
{
    std::map<std::string, std::size_t> missed = summary.loops_without_weight;
    for (const auto& [reason, count] : summary.loops_withheld) missed[reason] += count;
    for (const auto told : {Withheld::not_calibrated,
                            Withheld::distorted,
                            Withheld::no_odometry,
                            Withheld::frame_without_pose,
                            Withheld::stood_still,
                            Withheld::not_enabled})
        missed.erase(to_word(told));
    std::size_t sum = 0;
    std::string reasons;
    for (const auto& [reason, count] : missed)
    {
        sum += count;
        reasons += (reasons.empty() ? "" : ", ") + reason + " " + std::to_string(count);
    }
    if (2 * sum > map.loops.size())
        notes.push_back(std::to_string(sum) + " of " + count_of(map.loops.size(), "loop closure") +
                        (sum == 1 ? " has" : " have") + " no part in the map: " + reasons);
}

void add_note_on_frames(const Map& map, const MapSummary& summary, Notes& notes)
{
    if (map.trajectory.poses().empty() || summary.frames_without_pose == 0) return;
    notes.push_back(count_of(summary.frames_without_pose, "frame") +
                    " without a pose, for which no motion is known");
}
}  // namespace

std::vector<std::string> notes_on_map(const Map& map,
                                      const MapSummary& summary,
                                      const TGraphOptions& options)
{
    Notes notes;
    add_notes_on_sources(map, notes);
    for (const auto& recorded : map.recorded) add_notes_on_readings(recorded, options, notes);
    add_notes_on_agreement(map, notes);
    add_note_on_frames(map, summary, notes);
    add_notes_on_loops(summary, notes);
    add_note_on_most_loops(map, summary, notes);
    return notes;
}

}  // namespace fild
