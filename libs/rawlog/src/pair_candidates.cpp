// SPDX-License-Identifier: BSD-3-Clause
#include "pair_candidates.h"

#include "fild/core/angle.h"
#include "fild/core/frame.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/pose_conversion.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
using mrpt::obs::CObservationImage;

bool look_the_same_way(const RigidTransform& first_from_second)
{
    constexpr double kMostDegrees = 20;
    return cv::norm(vector_from_rotation(first_from_second.rotation)) <
           kMostDegrees * kRadiansPerDegree;
}

bool have_one_place(const RigidTransform& first_from_second)
{
    constexpr double kShortest = 1e-3;  // metres, as is_usable_baseline()
    return cv::norm(first_from_second.translation) < kShortest;
}

bool is_calibrated(const CObservationImage& image)
{
    return camera_model_from(image.cameraParams).has_value();
}
}  // namespace

PairFit fit_of_pair(const CObservationImage& first,
                    const CObservationImage& second,
                    bool has_calibration)
{
    const auto first_from_second =
        rigid_transform_from(first.cameraPose).inverse() * rigid_transform_from(second.cameraPose);
    if (!look_the_same_way(first_from_second)) return PairFit::apart;
    if (have_one_place(first_from_second)) return PairFit::same_place;
    const bool is_first_left = is_usable_baseline(first_from_second);
    if (!is_first_left && !is_usable_baseline(first_from_second.inverse())) return PairFit::apart;
    if (!has_calibration && !(is_calibrated(first) && is_calibrated(second)))
        return PairFit::not_calibrated;
    return is_first_left ? PairFit::first_is_left : PairFit::second_is_left;
}

PairCandidates::Trial& PairCandidates::trial_of(const std::string& label,
                                                const SingleImage& image,
                                                const std::string& other_label,
                                                const SingleImage& other)
{
    const bool is_first = label < other_label;
    const auto [entry, is_new] = trials_.try_emplace(is_first ? std::pair(label, other_label)
                                                              : std::pair(other_label, label));
    auto& [labels, trial] = *entry;
    if (!is_new) return trial;
    const auto& first = is_first ? *image : *other;
    const auto& second = is_first ? *other : *image;
    trial.fit = fit_of_pair(first, second, has_calibration_);
    trial.without_calibration = is_calibrated(first) ? labels.second : labels.first;
    return trial;
}

std::vector<StereoLabels> PairCandidates::add(const std::string& label, const SingleImage& image)
{
    constexpr std::size_t kMostDifferences = 1000;
    constexpr std::size_t kMostCameras = 16;
    if (image->timestamp == INVALID_TIMESTAMP) return {};
    if (latest_.size() >= kMostCameras && latest_.count(label) == 0) return {};
    std::vector<StereoLabels> pairs;
    for (const auto& [other_label, other] : latest_)
    {
        if (other_label == label) continue;
        auto& trial = trial_of(label, image, other_label, other);
        const double difference = std::abs(mrpt::Clock::toDouble(image->timestamp) -
                                           mrpt::Clock::toDouble(other->timestamp));
        if (trial.differences.size() < kMostDifferences) trial.differences.push_back(difference);
        const auto& [first, second] = std::minmax(label, other_label);
        if (difference > tolerance_) continue;
        if (trial.fit == PairFit::first_is_left) pairs.push_back({first, second});
        if (trial.fit == PairFit::second_is_left) pairs.push_back({second, first});
    }
    latest_[label] = image;
    return pairs;
}

std::optional<double> usual_difference(const PairCandidates::Trial& trial)
{
    if (trial.differences.empty()) return std::nullopt;
    auto sorted = trial.differences;
    const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
    std::nth_element(sorted.begin(), quarter, sorted.end());
    return *quarter;
}

}  // namespace fild
