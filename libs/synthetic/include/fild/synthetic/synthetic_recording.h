// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/render/offscreen_renderer.h"
#include "fild/synthetic/street_grid.h"
#include "fild/synthetic/synthetic_options.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace fild
{
/** Time stamp of a recording's first frame: 2020-01-01 00:00:00 UTC, seconds since the epoch. */
constexpr double kRecordingStart = 1577836800;

/** Draws what a camera sees under the conditions of a lap: Town::draw(), or a stand-in. */
using DrawView = std::function<RenderedView(
    const CameraModel&, const mrpt::poses::CPose3D& map_from_camera, const LapConditions&)>;

/** Threads that draw beside the calling one: with n of them each thread draws every (n + 1)-th
 *  frame. */
struct DrawingHelpers
{
    std::size_t count = 0;
    /** Called once in each thread; what it returns is used and destroyed there, and must draw what
     *  the caller's DrawView draws. May be empty when count is 0. */
    std::function<DrawView()> make{};
};

/** Told after each frame how far a recording is. What it throws ends the recording. */
using OnFrame =
    std::function<void(std::size_t frames_done, std::size_t frames, std::size_t loops_found)>;

/** What write_synthetic_recording() is to make. Value type. */
struct SyntheticRequest
{
    std::string rawlog_path;  ///< must end in ".rawlog"
    bool embed = false;  ///< pixels in the rawlog rather than in files beside it
    TSyntheticOptions options;
};

/** What write_synthetic_recording() made. Value type. */
struct SyntheticSummary
{
    std::size_t frames = 0;
    std::size_t loops = 0;  ///< pairs of frames
    std::size_t queries_with_loop = 0;
    double metres = 0;  ///< driven
    std::vector<std::string> paths;  ///< of all that was made, the rawlog first
};

/** A line for the user. */
std::string to_text(const SyntheticSummary& summary);

/** Drives plan_route() through a town and records what the sensors measure.
 *
 *  Beside `NAME.rawlog` come, all or none of them: `NAME_Images` with a JPEG for each image (unless
 *  embedded); `NAME.gt.tum` with the true pose of the robot for each frame: "timestamp x y z qx qy
 *  qz qw"; and `NAME.loops.txt`, see OverlapLoops. Nothing appears under its name before all is
 *  done. Holds a frame, two more for each helper, and the points of OverlapLoops in memory.
 *  Deterministic: the same options, grid and drawing give the same bytes, with any number of
 *  helpers.
 *  \throw std::invalid_argument on bad options, or a path that does not end in ".rawlog".
 *  \throw std::runtime_error naming the file: one of them exists already; disk full.
 *  Throws what `draw` throws in any thread. */
SyntheticSummary write_synthetic_recording(const SyntheticRequest& request,
                                           const StreetGrid& grid,
                                           const DrawView& draw,
                                           const OnFrame& on_frame,
                                           const DrawingHelpers& helpers = {});

}  // namespace fild
