// SPDX-License-Identifier: BSD-3-Clause
// From a rawlog and its true poses to metric loop edges and their errors.
#pragma once

#include "fild/core/angle.h"
#include "fild/features/surf.h"
#include "fild/geometry/fundamental_verifier.h"
#include "fild/geometry/image_depths.h"
#include "fild/geometry/relative_pose.h"
#include "fild/geometry/stereo_depths.h"
#include "fild/matching/code_hasher.h"
#include "fild/matching/code_matcher.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/paired_rawlog.h"
#include "fild/rawlog/pose_conversion.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace fild::testing
{
/** What a map keeps of a frame. */
struct KeptFrame
{
    std::optional<CameraModel> camera;
    RigidTransform robot_from_camera;
    HashedFeatures local;
    KeypointDepths depths;
};

/** SURF and binary codes with the settings of config-ini/default.ini. */
class Describer
{
 public:
    HashedFeatures describe(const cv::Mat& image) const
    {
        const auto features = surf_.extract(image);
        HashedFeatures hashed;
        hashed.positions.reserve(features.size());
        for (const auto& keypoint : features.keypoints)
            hashed.positions.push_back({keypoint.x, keypoint.y});
        hashed.codes = hasher_.hash(features, 1);
        return hashed;
    }

 private:
    static TLocalFeatureOptions surf_options()
    {
        TLocalFeatureOptions options;
        options.max_keypoints = 3000;
        return options;
    }

    SurfExtractor surf_{surf_options()};
    CodeHasher hasher_{THashingOptions(), surf_statistics(), 1};
};

inline KeptFrame kept(const Frame& frame, const Describer& describer)
{
    KeptFrame result{frame.camera, *frame.robot_from_camera, describer.describe(frame.image), {}};
    const TDepthOptions options;
    if (depth_source_of(frame) == DepthSource::stereo)
        result.depths = depths_from_stereo(
            frame, result.local, describer.describe(frame.right->image), options);
    if (depth_source_of(frame) == DepthSource::depth_image)
        result.depths = depths_from_image(frame, result.local.positions, options);
    return result;
}

/** All frames of a rawlog's camera. */
inline std::vector<KeptFrame> read_frames(const std::string& rawlog)
{
    PairedRawlog reader(rawlog, {});
    FrameBuilder builder(TInputOptions(), rawlog, FrameContent::metric);
    const Describer describer;
    std::vector<KeptFrame> frames;
    while (const auto observation = reader.next())
        if (builder.accepts(*observation))
            frames.push_back(kept(builder.build(*observation), describer));
    return frames;
}

/** map_from_robot of each frame, from a file in TUM's format. */
inline std::vector<RigidTransform> read_tum(const std::string& path)
{
    std::vector<RigidTransform> poses;
    std::ifstream file(path);
    double t = 0;
    mrpt::math::TPoint3D p;
    mrpt::math::CQuaternionDouble q;
    while (file >> t >> p.x >> p.y >> p.z >> q[1] >> q[2] >> q[3] >> q[0])
        poses.push_back(
            rigid_transform_from(mrpt::poses::CPose3D(mrpt::poses::CPose3DQuat(p.x, p.y, p.z, q))));
    return poses;
}

struct FramePair
{
    std::size_t query = 0;
    std::size_t candidate = 0;
};

/** Of each query in a list of loops the candidate that was nearest to it in truth. */
inline std::vector<FramePair> nearest_loops(const std::string& loops_path,
                                            const std::vector<RigidTransform>& truth)
{
    std::map<std::size_t, std::size_t> nearest;
    std::ifstream file(loops_path);
    for (std::string line; std::getline(file, line);)
    {
        FramePair pair;
        std::istringstream words(line);
        int sure = 1;
        if (line[0] == '#' || !(words >> pair.query >> pair.candidate)) continue;
        if (words >> sure && sure == 0) continue;
        const auto distance = [&](std::size_t candidate)
        { return cv::norm(truth.at(candidate).translation - truth.at(pair.query).translation); };
        const auto [found, is_new] = nearest.emplace(pair.query, pair.candidate);
        if (!is_new && distance(pair.candidate) < distance(found->second))
            found->second = pair.candidate;
    }
    std::vector<FramePair> pairs;
    pairs.reserve(nearest.size());
    for (const auto& [query, candidate] : nearest) pairs.push_back({query, candidate});
    return pairs;
}

/** Matches that agree with a fundamental matrix; none when the pair is not verified. */
inline std::vector<Match> verified_matches(const HashedFeatures& query,
                                           const HashedFeatures& candidate)
{
    THashingOptions hashing;
    hashing.ratio = 0.837;
    hashing.mutual_check = true;
    TVerificationOptions verification;
    verification.method = RansacMethod::magsac;
    const auto matches = CodeMatcher(hashing).match(query.codes, candidate.codes);
    MatchedPixels matched;
    matched.query.reserve(matches.size());
    matched.candidate.reserve(matches.size());
    for (const auto& match : matches)
    {
        matched.query.push_back(query.positions[match.query]);
        matched.candidate.push_back(candidate.positions[match.candidate]);
    }
    const auto verified = FundamentalVerifier(verification, 1).verify(matched);
    std::vector<Match> kept;
    if (verified.rejection != Rejection::none) return kept;
    kept.reserve(verified.inliers.size());
    for (const auto k : verified.inliers) kept.push_back(matches[k]);
    return kept;
}

/** How far a metric pose is off. */
struct EdgeError
{
    double metres = 0;
    double degrees = 0;
    double nees = 0;  ///< normalised estimation error squared, six degrees of freedom
};

inline EdgeError error_of(const UncertainTransform& estimate, const RigidTransform& truth)
{
    const auto& b_from_a = estimate.b_from_a;
    const auto position = truth.translation - b_from_a.translation;
    const auto rotation = vector_from_rotation(b_from_a.rotation.t() * truth.rotation);
    const cv::Vec<double, 6> error(
        position[0], position[1], position[2], rotation[0], rotation[1], rotation[2]);
    return {cv::norm(position),
            cv::norm(rotation) / kRadiansPerDegree,
            error.dot(estimate.covariance.inv() * error)};
}

/** Loop edges of a drive. */
struct EdgeStatistics
{
    std::size_t pairs = 0;
    std::size_t verified = 0;  ///< by a fundamental matrix
    std::map<std::string, std::size_t> reasons;  ///< why verified pairs have no edge
    std::vector<EdgeError> errors;
    std::vector<double> pixel_deviations;
    std::vector<double> depth_factors;
    std::vector<double> inlier_shares;

    double median(double EdgeError::*field) const
    {
        std::vector<double> values;
        values.reserve(errors.size());
        for (const auto& error : errors) values.push_back(error.*field);
        return median_of(values);
    }

    static double median_of(std::vector<double> values)
    {
        if (values.empty()) return std::nan("");
        std::nth_element(
            values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
        return values[values.size() / 2];
    }

    double mean_nees() const
    {
        double sum = 0;
        for (const auto& error : errors) sum += error.nees;
        return sum / static_cast<double>(errors.size());
    }

    /** Share of edges beyond the 99.9 % quantile of the chi-squared distribution. */
    double share_beyond() const
    {
        constexpr double kQuantile = 22.458;
        const auto beyond = std::count_if(
            errors.begin(), errors.end(), [](const EdgeError& e) { return e.nees > kQuantile; });
        return static_cast<double>(beyond) / static_cast<double>(errors.size());
    }

    std::string text() const
    {
        std::ostringstream out;
        out << pairs << " pairs, " << verified << " verified, " << errors.size()
            << " edges; medians: " << 100 * median(&EdgeError::metres) << " cm, "
            << median(&EdgeError::degrees) << " deg, NEES " << median(&EdgeError::nees)
            << ", pixel " << median_of(pixel_deviations) << " px, depth factor "
            << median_of(depth_factors) << ", inlier share " << median_of(inlier_shares)
            << "; NEES mean " << mean_nees() << ", beyond 99.9 %: " << 100 * share_beyond() << " %";
        for (const auto& [word, count] : reasons) out << "; " << word << ": " << count;
        return out.str();
    }
};

inline EdgeStatistics edge_statistics(const std::vector<KeptFrame>& frames,
                                      const std::vector<RigidTransform>& truth,
                                      const std::vector<FramePair>& pairs)
{
    const RelativePoseEstimator estimator(TRelativePoseOptions(), 1);
    EdgeStatistics statistics;
    statistics.pairs = pairs.size();
    for (const auto& pair : pairs)
    {
        const auto& query = frames.at(pair.query);
        const auto& candidate = frames.at(pair.candidate);
        const auto matches = verified_matches(query.local, candidate.local);
        if (matches.empty()) continue;
        ++statistics.verified;
        const auto pose =
            estimator.estimate({query.camera, query.local.positions, query.depths},
                               {candidate.camera, candidate.local.positions, candidate.depths},
                               matches);
        if (!pose.candidate_from_query)
        {
            ++statistics.reasons[to_word(pose.reason)];
            continue;
        }
        const auto true_pose = (truth.at(pair.candidate) * candidate.robot_from_camera).inverse() *
                               (truth.at(pair.query) * query.robot_from_camera);
        statistics.errors.push_back(error_of(*pose.candidate_from_query, true_pose));
        statistics.pixel_deviations.push_back(pose.pixel_deviation_px);
        statistics.depth_factors.push_back(pose.depth_deviation_factor);
        statistics.inlier_shares.push_back(pose.inlier_share);
    }
    return statistics;
}

}  // namespace fild::testing
