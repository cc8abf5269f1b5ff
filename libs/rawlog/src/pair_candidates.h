// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/input_options.h"
#include "partner_search.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** What two cameras are to each other by their calibrations and poses. */
enum class PairFit
{
    first_is_left,
    second_is_left,
    not_calibrated,  ///< one of them or both; they stand and look as a pair
    same_place,  ///< they look the same way and have no baseline
    apart  ///< they look elsewhere, or stand one before the other
};

/** \param has_calibration  of both cameras from elsewhere. */
PairFit fit_of_pair(const mrpt::obs::CObservationImage& first,
                    const mrpt::obs::CObservationImage& second,
                    bool has_calibration);

/** Looks for two cameras that are a stereo pair among all that there are.
 *  Not thread-safe: one caller at a time. */
class PairCandidates
{
 public:
    /** Two cameras by their labels, in alphabetical order. */
    struct Trial
    {
        PairFit fit = PairFit::apart;
        std::string without_calibration;  ///< label of one such camera
        std::vector<double> differences;  ///< of time stamps to the other's image before, seconds
    };
    using Trials = std::map<std::pair<std::string, std::string>, Trial>;

    PairCandidates(bool has_calibration, double tolerance_seconds)
        : has_calibration_(has_calibration), tolerance_(tolerance_seconds)
    {
    }

    /** Compares an image with the latest one of every other camera, of sixteen cameras at most.
     *  \return pairs that this image makes with one of them. */
    std::vector<StereoLabels> add(const std::string& label, const SingleImage& image);

    const Trials& trials() const { return trials_; }

 private:
    Trial& trial_of(const std::string& label,
                    const SingleImage& image,
                    const std::string& other_label,
                    const SingleImage& other);

    bool has_calibration_;
    double tolerance_;
    std::map<std::string, SingleImage> latest_;  ///< by label
    Trials trials_;
};

/** Of the differences the one that a quarter is below: the images of a pair come in turn, so that
 *  one difference of two leads to the next pair. Nothing without any. */
std::optional<double> usual_difference(const PairCandidates::Trial& trial);

}  // namespace fild
