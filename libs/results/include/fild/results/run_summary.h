// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** What summary.json says of a source of the robot's motion. Value type. */
struct MotionSourceSummary
{
    std::string kind;  ///< odometry, vision or gps
    std::string name;
    std::size_t factors = 0;  ///< motions, or positions of keyframes
    std::size_t without_weight = 0;  ///< positions that the rest of the graph contradicts
    std::size_t contradictions = 0;  ///< motions that odometry and images tell differently
    double noise_scale = 1;  ///< of the standard deviations
    std::string left_out{};  ///< the reason; empty for a source with a part in the map
};

/** Where the origin of a map is. Value type. */
struct MapOrigin
{
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
};

/** What summary.json says of a run's map. Value type. */
struct MapSummary
{
    std::string trajectory;  ///< none, recorded, vision or combined
    std::string trajectory_source;  ///< names of the sources; empty: none
    std::vector<std::string> other_sources;  ///< of motion, not used
    std::vector<MotionSourceSummary> sources{};
    double loop_noise_scale = 1;  ///< of the standard deviations of loops
    double motion_noise_scale = 1;  ///< of those of the motion between keyframes
    /** Of a map in metres east, north and up of it. */
    std::optional<MapOrigin> origin{};
    std::size_t frames_without_pose = 0;
    std::size_t resets = 0;  ///< of the odometry, or breaks of what the images tell
    std::size_t gaps = 0;  ///< times without a reading
    std::size_t clock_jumps = 0;  ///< of the readings
    std::size_t late_readings = 0;  ///< left out: up to a second older than the one before
    std::size_t unusable_readings = 0;
    std::size_t implausible_readings = 0;  ///< GPS fixes that only a robot too fast can reach
    /** Frames by where the depths of their keypoints come from, and by why there are none. */
    std::map<std::string, std::size_t> depth_sources;
    std::map<std::string, std::size_t> depth_defects;
    std::size_t nodes = 0;
    std::size_t odometry_edges = 0;
    std::size_t loop_edges = 0;  ///< with a weight of more than 0
    std::map<std::string, std::size_t> loops_without_weight;  ///< edges, by why
    std::map<std::string, std::size_t> loops_withheld;  ///< that are no edges, by why
    double chi2_before = 0;
    double chi2_after = 0;
    std::vector<std::size_t> parts;  ///< nodes of each, the largest first
    bool is_largest_set = true;  ///< of consistent loops
    int optimizations = 0;
    std::vector<std::string> notes;  ///< what the user should know
};

/** Two cameras that were taken for a stereo pair. Value type. */
struct PairSummary
{
    std::string left;  ///< sensor labels
    std::string right;
    std::size_t frames_with_right_image = 0;
    std::size_t frames_without = 0;
    std::size_t right_images_alone = 0;  ///< that are in no frame
};

/** What summary.json says of a run. */
struct RunSummary
{
    /** Section name and its keys with values, as in the .ini file. */
    using OptionValues =
        std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>>;

    std::string command;  ///< as it can be typed into a shell again
    std::string rawlog;
    std::size_t max_frames = 0;  ///< asked for; 0: all
    /** Why the run ended before the rawlog, or the frames asked for, did; empty for a complete run.
     */
    std::string ended_early;
    std::size_t camera_frames = 0;
    std::size_t loop_closures = 0;
    std::map<Rejection, std::size_t> frames_by_rejection;  ///< `none`: the loop closures
    std::size_t clock_jumps = 0;  ///< of the cameras' time stamps: RecordingClock::jumps()
    std::size_t scaled_frames = 0;  ///< to the size of their camera's first image
    std::vector<std::string> ignored_camera_labels;
    std::optional<PairSummary> stereo_pair;  ///< of two cameras that record one by one
    std::vector<std::string> frame_notes;  ///< what the user should know of the frames
    double mean_keypoints = 0;
    std::size_t match_pictures = 0;  ///< of loop closures and of rejected pairs
    /** One row of similarity.png is so many frames after the row above; 0: there is none. */
    std::size_t frames_per_similarity_row = 0;
    MapSummary map;
    OptionValues options;
    std::vector<std::pair<std::string, std::string>> versions;
    std::string model_file;
    std::string model_sha256;
    std::map<std::string, StageTimes::Statistics> stage_times;
    double wall_seconds = 0;
    std::string finished;  ///< date and time, "2026-01-31 12:30:00 UTC"
    std::size_t peak_memory_bytes = 0;
    std::size_t map_bytes = 0;  ///< held for later frames at the end of the run

    /** Counts a frame and its keypoints. */
    void add(const FrameVerdict& verdict);

    /** Frames that the detector could look at. */
    std::size_t usable_frames() const;
};

/** Writes the summary; the file appears when it is whole. \throw std::runtime_error as WholeFile.
 */
void write_summary(const RunSummary& summary, const std::string& path);

/** [index] delay_seconds of the run whose summary.json this is; nothing when there is no such file,
 *  or it does not tell. */
std::optional<double> read_run_delay(const std::string& path);

/** SHA-256 of a file's bytes in hexadecimal. \throw std::runtime_error when it cannot be read. */
std::string sha256_of_file(const std::string& path);

}  // namespace fild
