// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/synthetic/town.h"

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace fild
{
/** Section [conditions] of synthetic-rawlog: what changes between laps, and what the camera adds.
 */
struct TConditionsOptions : Options
{
    /** How much exposure and sun differ from lap to lap: 0 not at all; 1 exposure by a factor of up
     *  to 2, the sun by up to a right angle. */
    double light_change = 0.3;
    bool parked_cars_change = true;  ///< other cars stand in the streets in each lap
    /** How many pedestrians and vehicles are in the streets and hide what is behind them: see
     *  RoadUsers. */
    double occluders = 0;
    /** How far the season goes on after the first lap: 0 it is summer always; 1 late autumn, with
     *  other leaves, bare trees and leaves on the ground. */
    double season_change = 0;
    double image_noise = 2;  ///< standard deviation of each channel, grey values of 255
    double blur_px = 0.5;  ///< standard deviation of the Gaussian blur; 0: none

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Light, season and parked cars of a lap (from 0), without road users. Lap 0 has the default light
 *  in summer; every other lap differs from it by at least half of what the options allow.
 *  Deterministic.
 *  \throw std::invalid_argument on bad options. */
LapConditions conditions_of_lap(const TConditionsOptions& options, int lap, std::uint64_t seed);

/** A drawn image as a camera would have taken it: blurred, then with noise in each channel.
 *  \param image  8 bit BGR. \param index  of the image among all of the recording: the noise
 *  depends on it and on the seed only. \return an image of the same size and kind.
 *  Deterministic. \throw std::invalid_argument when the image is not 8 bit BGR. */
cv::Mat with_image_effects(const cv::Mat& image,
                           const TConditionsOptions& options,
                           std::uint64_t seed,
                           std::uint64_t index);

}  // namespace fild
