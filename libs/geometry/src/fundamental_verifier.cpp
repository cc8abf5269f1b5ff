// SPDX-License-Identifier: BSD-3-Clause
// Geometric verification of FILD (An et al., IROS 2019), section III-C.
#include "fild/geometry/fundamental_verifier.h"

#include "usac.h"

#include <opencv2/calib3d.hpp>

#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
cv::UsacParams usac_parameters(const TVerificationOptions& options, int random_state)
{
    auto usac = magsac_parameters(
        {options.max_epipolar_error_px, options.confidence, options.max_iterations}, random_state);
    switch (options.method)
    {
        case RansacMethod::magsac:
            break;
        case RansacMethod::ransac:
            usac.loMethod = cv::LOCAL_OPTIM_NULL;
            usac.score = cv::SCORE_METHOD_RANSAC;
            break;
        case RansacMethod::lo_ransac:
            usac.loMethod = cv::LOCAL_OPTIM_INNER_LO;
            usac.score = cv::SCORE_METHOD_RANSAC;
            break;
        case RansacMethod::graph_cut:
            usac.loMethod = cv::LOCAL_OPTIM_GC;
            usac.score = cv::SCORE_METHOD_MSAC;
            break;
    }
    return usac;
}

/** The model of a camera that has not moved: every match is where it was. OpenCV's estimators
 * refuse such matches, since every skew-symmetric F fits them; this is one of those. */
Verification without_motion(const std::vector<PixelPosition>& query,
                            const std::vector<PixelPosition>& candidate,
                            double max_error_px)
{
    Verification result;
    for (std::size_t k = 0; k < query.size(); ++k)
        if (std::hypot(query[k].x - candidate[k].x, query[k].y - candidate[k].y) <= max_error_px)
            result.inliers.push_back(k);
    if (2 * result.inliers.size() <= query.size())
    {
        result.inliers.clear();
        result.rejection = Rejection::no_model;
        return result;
    }
    result.candidate_from_query_f = cv::Matx33d(0, -1, 0, 1, 0, 0, 0, 0, 0);
    return result;
}

std::vector<cv::Point2f> to_points(const std::vector<PixelPosition>& pixels)
{
    std::vector<cv::Point2f> points;
    points.reserve(pixels.size());
    for (const auto& pixel : pixels) points.emplace_back(pixel.x, pixel.y);
    return points;
}
}  // namespace

FundamentalVerifier::FundamentalVerifier(const TVerificationOptions& options, std::uint64_t seed)
    : options_(options), random_state_(usac_random_state(seed))
{
    options_.check();
}

Verification FundamentalVerifier::verify(const MatchedPixels& matched) const
{
    const auto matches = matched.query.size();
    if (matches != matched.candidate.size())
        throw std::invalid_argument("FundamentalVerifier: unlike numbers of pixels");
    if (matches < static_cast<std::size_t>(options_.min_inliers))
    {
        Verification too_few;
        too_few.rejection = Rejection::too_few_matches;
        return too_few;
    }
    auto result = fit(matched);
    if (result.rejection != Rejection::none) return result;
    if (result.inliers.size() < static_cast<std::size_t>(options_.min_inliers))
        result.rejection = Rejection::too_few_inliers;
    return result;
}

Verification FundamentalVerifier::fit(const MatchedPixels& matched) const
{
    std::vector<unsigned char> is_inlier;
    const cv::Mat f = cv::findFundamentalMat(to_points(matched.query),
                                             to_points(matched.candidate),
                                             is_inlier,
                                             usac_parameters(options_, random_state_));
    if (f.rows != 3 || f.cols != 3)
        return without_motion(matched.query, matched.candidate, options_.max_epipolar_error_px);
    Verification result;
    result.candidate_from_query_f = cv::Matx33d(f);
    for (std::size_t k = 0; k < is_inlier.size(); ++k)
        if (is_inlier[k] != 0) result.inliers.push_back(k);
    return result;
}

}  // namespace fild
