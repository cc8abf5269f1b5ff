// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"

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
};

/** Draws query (left) and candidate (right), one above the other when they are more than twice as
 * wide as high, a thin line for every inlier match, and a caption with frames, time between them,
 *  similarity, matches and inliers. Colours run along the image's height, in an order that
 * colour-blind readers can follow. Deterministic. Thread-safe. \return 8 bit BGR, as large as both
 * images and the caption. \throw std::invalid_argument when an image is empty or the verdict names
 * no candidate. */
cv::Mat draw_match_picture(const MatchPicture& picture);

}  // namespace fild
