// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/rigid_transform.h"
#include "fild/core/verdict.h"
#include "fild/render/render_options.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace fild
{
/** What a match picture shows: a frame, its candidate, and the matched pixels that agree. */
struct MatchPicture
{
    cv::Mat query_image;  ///< 8 bit, grey or BGR
    cv::Mat candidate_image;  ///< 8 bit, grey or BGR; may differ in size
    FrameVerdict verdict;  ///< of the query; must name a candidate
    double candidate_timestamp = 0;  ///< seconds since the UNIX epoch
    std::vector<PixelPair> inliers;
    std::vector<PixelPair> rejected{};  ///< matches that are no inliers; drawn grey
    double support_threshold = 1;  ///< FrameVerdict::support from which the frame is accepted
};

/** Where the cameras of a match picture were. Value type. */
struct CameraPair
{
    CameraModel query;  ///< a pinhole, of the query's image
    CameraModel candidate;
    /** Pose of the query's camera seen from the candidate's, metres; x right, y down, z forward. */
    RigidTransform candidate_from_query;
};

/** Draws query and candidate side by side or, where they are then larger, one above the other:
 *  marks on every inlier, thin lines between some of them, evenly over the images, and captions
 *  with frames, times, similarity, matches, inliers and support. Colours run along the side that
 *  the images share, in an order that colour-blind readers can follow, so that a line that leaves
 *  its neighbours shows. Deterministic. Thread-safe.
 *  \return 8 bit BGR, TRenderOptions::match_picture_width_px wide or less: larger images are scaled
 *          down, and those less than 500 pixels wide up to that.
 *  \throw std::invalid_argument when an image is empty or the verdict names no candidate. */
cv::Mat draw_match_picture(const MatchPicture& picture, const TRenderOptions& options);

/** Draws both images where their cameras stood, as far before them as fits the distance between
 *  them, with lines between inliers, from the side where one hides least of the other. Through
 *  OffscreenRenderer. Deterministic. Throws as draw_match_picture(), and std::invalid_argument when
 *  a camera is no pinhole of a size or the pose is not finite. */
cv::Mat draw_match_picture_3d(const MatchPicture& picture,
                              const CameraPair& cameras,
                              const TRenderOptions& options);

}  // namespace fild
