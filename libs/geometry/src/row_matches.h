// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <opencv2/core/types.hpp>

#include <vector>

namespace fild
{
/** Which keypoints of a rectified pair may be one point. */
struct RowSearch
{
    double max_row_error_px = 2;
    double max_disparity_px = 0;
    double ratio = 0.9;  ///< of Hamming distances, nearest against second nearest
};

/** Matches keypoints of a rectified pair by code along their row: each is the other's nearest. Of
 *  the second nearest only those count that are elsewhere: blobs of several sizes have one centre.
 *  \param left,right  rectified pixels. \return Match::query of left, Match::candidate of right, in
 *  order of left. Deterministic: among equal distances the lower index wins. */
std::vector<Match> match_on_rows(const std::vector<cv::Point2d>& left,
                                 const BinaryCodes& left_codes,
                                 const std::vector<cv::Point2d>& right,
                                 const BinaryCodes& right_codes,
                                 const RowSearch& search);

}  // namespace fild
