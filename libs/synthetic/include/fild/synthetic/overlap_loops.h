// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/options.h"
#include "fild/core/verdict.h"

#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include <iosfwd>
#include <memory>
#include <vector>

namespace fild
{
/** Section [truth] of synthetic-rawlog: which pairs of frames count as a loop. */
struct TTruthOptions : Options
{
    double overlap = 0.4;  ///< least share of one frame's pixels that the other sees, too
    /** Earlier frames younger than this are no candidates; the delay of config-ini/default.ini. */
    double min_age_seconds = 20;
    double max_distance_m = 10;  ///< between the cameras
    double max_angle_deg = 45;  ///< between the optical axes: the same direction of travel

    /** A pair that is no loop is doubtful from this overlap on, in either direction: the two frames
     *  show some of the same surface, so a match between them is not wrong. */
    double doubtful_overlap = 0.03;
    double doubtful_overlap_distance_m = 100;  ///< largest distance at which overlap is looked for
    double doubtful_overlap_angle_deg = 90;  ///< largest angle at which overlap is looked for
    /** A pair within this distance and doubtful_max_angle_deg is doubtful whatever it shows. */
    double doubtful_max_distance_m = 15;
    double doubtful_max_angle_deg = 60;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Two frames of the same place. Value type. */
struct LoopPair
{
    FrameId query{};
    FrameId candidate{};  ///< the earlier one
    double overlap = 0;  ///< share of one frame's pixels that the other sees: the greater of both
};

/** Finds all loops of a drive from what the cameras truly see.
 *
 *  For a query and an earlier frame that is old, near and turned the same way enough, a grid of the
 *  earlier frame's pixels is taken into space by their depth and projected into the query. A pixel
 *  is seen there when it falls into the image and the query's depth at that place agrees, within
 *  3 % and 0.1 m; so what stands before it hides it. Pixels without depth (the sky) do not count.
 *
 *  Of the other pairs of that age, those are doubtful that show some of the same surface in either
 *  direction (the candidate's pixels in the query, or the query's in the candidate), and those that
 *  are near and turned alike. All that remain are wrong.
 *
 *  Keeps some 1,000 points and 80 x 60 depths of each frame, for images of 4:3. Deterministic. Not
 *  thread-safe: one caller at a time. */
class OverlapLoops
{
 public:
    /** \param camera  of all frames, a pinhole. \throw std::invalid_argument on bad options. */
    OverlapLoops(const TTruthOptions& options, const CameraModel& camera);
    OverlapLoops(const OverlapLoops&) = delete;
    OverlapLoops& operator=(const OverlapLoops&) = delete;
    ~OverlapLoops();

    /** Takes the next frame and finds its loops with all before. Cost: the number of earlier
     *  frames, and up to two projections of the points of those within the largest distance.
     *  \param map_from_camera  x right, y down, z forward.
     *  \param depth  float, metres along the optical axis, of the camera's size; 0: none.
     *  \throw std::invalid_argument when depth is of another size or kind. */
    void add(double seconds, const mrpt::math::TPose3D& map_from_camera, const cv::Mat& depth);

    /** All loops up to now, by query, then candidate. */
    const std::vector<LoopPair>& pairs() const;
    /** All doubtful pairs up to now, in the same order. */
    const std::vector<LoopPair>& doubtful_pairs() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/** Writes loops as loop-closure-eval reads them: a line "query candidate" each, then a line "query
 *  candidate 0" for each doubtful pair, after lines that begin with '#' and say how they were
 *  found. */
void write_loops(std::ostream& out,
                 const TTruthOptions& options,
                 const std::vector<LoopPair>& pairs,
                 const std::vector<LoopPair>& doubtful_pairs);

}  // namespace fild
