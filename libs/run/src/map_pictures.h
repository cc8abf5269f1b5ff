// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/judged_frame.h"
#include "fild/job/output_folder.h"
#include "fild/mapping/map_builder.h"
#include "fild/places/place_map.h"
#include "fild/render/map_scene.h"
#include "fild/render/render_options.h"

#include <map>
#include <vector>

namespace fild
{
/** What the pictures of a map show.
 *  \param map  with at least one pose. \param verdicts  of all camera frames. */
DrawnMap to_drawn_map(const Map& map,
                      const std::vector<FrameVerdict>& verdicts,
                      const TRenderOptions& options);

/** Marks the loops as right, wrong or doubtful, and adds the frames that are missed. */
void add_judgements(DrawnMap& drawn, const std::vector<JudgedFrame>& frames);

/** The cameras of keyframes as [render] chooses them, without images; those that are not calibrated
 *  are left out. */
std::map<FrameId, DrawnCamera> cameras_of(const Map& map,
                                          const PlaceMap& places,
                                          const TRenderOptions& options);

/** The true positions along the way, laid over the map.
 *  \throw std::runtime_error as laid_over(). */
std::vector<cv::Vec3d> true_way_over(const Map& map, const std::vector<PosedFrame>& truth);

/** Writes map_top.png, map_perspective.png and map.3Dscene; an interruption ends it early.
 *  \throw std::runtime_error when a file cannot be written. */
void write_map_pictures(const DrawnMap& map,
                        const TRenderOptions& options,
                        const OutputFolder& folder);

}  // namespace fild
