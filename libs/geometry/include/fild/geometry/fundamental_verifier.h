// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"
#include "fild/geometry/verification_options.h"

#include <opencv2/core/matx.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fild
{
/** Outcome of the geometric verification of one candidate. A fundamental matrix carries no metres:
 *  there is no pose in here. */
struct Verification
{
    /** none when verified, else too_few_matches, no_model or too_few_inliers. */
    Rejection rejection = Rejection::none;
    std::vector<std::size_t> inliers;  ///< indices of the matches that agree, ascending
    /** F with candidate' F query = 0 for homogeneous pixels, when RANSAC found one. */
    std::optional<cv::Matx33d> candidate_from_query_f;
};

/** The keypoints of two images that are taken for the same points: pixel k of one image matched
 * with pixel k of the other. */
struct MatchedPixels
{
    std::vector<PixelPosition> query;
    std::vector<PixelPosition> candidate;
};

/** Checks that matched pixels of two images are views of one rigid scene: a fundamental matrix by
 *  RANSAC with at least tau inliers, FILD (IROS 2019) section III-C. Const members may run
 *  concurrently. */
class FundamentalVerifier
{
 public:
    /** \param seed of the random samples; the same seed and matches give the same answer. */
    FundamentalVerifier(const TVerificationOptions& options, std::uint64_t seed);

    /** Where RANSAC finds no model and most matches have not moved, the camera has not either: they
     * are the inliers (two copies of one image are a loop, too). Fewer than tau matches are not
     * looked at: they cannot hold tau inliers. \throw std::invalid_argument when the sizes differ.
     */
    Verification verify(const MatchedPixels& matched) const;

 private:
    Verification fit(const MatchedPixels& matched) const;

    TVerificationOptions options_;
    int random_state_;
};

}  // namespace fild
