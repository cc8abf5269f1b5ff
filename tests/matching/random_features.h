// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/random.h"

#include <cmath>
#include <random>

namespace fild::testing
{
/** `count` features at (i, i) with descriptors of unit norm in random directions. */
inline LocalFeatures random_features(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    LocalFeatures features;
    for (std::size_t i = 0; i < count; ++i)
    {
        Keypoint keypoint;
        keypoint.x = keypoint.y = static_cast<float>(i);
        features.keypoints.push_back(keypoint);
        std::vector<float> x(LocalFeatures::dimension);
        double squares = 0;
        for (auto& value : x)
        {
            value = static_cast<float>(standard_normal(generator));
            squares += static_cast<double>(value) * value;
        }
        for (const auto value : x)
            features.descriptors.push_back(value / static_cast<float>(std::sqrt(squares)));
    }
    return features;
}

/** The features with noise of the given standard deviation (relative to unit norm) on each. */
inline LocalFeatures with_noise(LocalFeatures features, double sigma, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    const double per_number = sigma / std::sqrt(static_cast<double>(LocalFeatures::dimension));
    for (auto& value : features.descriptors)
        value += static_cast<float>(per_number * standard_normal(generator));
    return features;
}

}  // namespace fild::testing
