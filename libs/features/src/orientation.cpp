// SPDX-License-Identifier: BSD-3-Clause
// Orientation assignment: SURF (CVIU 2008) section 4.1.
#include "orientation.h"

#include "box_hessian.h"
#include "haar_wavelet.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace fild
{
namespace
{
constexpr float kTwoPi = 6.2831853071795864769F;
constexpr float kWindow = kTwoPi / 6.0F;
constexpr float kRadius = 6.0F;  // all lengths in units of the scale s
constexpr std::size_t kSamples = 13;  // across the disc, one scale apart
constexpr float kWaveletSide = 4.0F;
constexpr float kSigma = 2.5F;

struct WeightedResponse
{
    float angle = 0;
    cv::Vec2d gradient;
};

float angle_of(double dx, double dy)
{
    const auto angle = static_cast<float>(std::atan2(dy, dx));
    const float positive = angle < 0 ? angle + kTwoPi : angle;
    return positive < kTwoPi ? positive : 0.0F;
}

/** Where sample i of a row or column of the disc lies, from its centre. */
float sample_offset(std::size_t i)
{
    return static_cast<float>(i) - kRadius;
}

/** exp(-d^2 / 2 sigma^2) of the samples along one axis. */
std::array<float, kSamples> gaussian_weights()
{
    std::array<float, kSamples> weights{};
    for (std::size_t i = 0; i < kSamples; ++i)
        weights[i] = std::exp(sample_offset(i) * sample_offset(i) / (-2 * kSigma * kSigma));
    return weights;
}

/** Responses that are not 0, by angle. */
std::vector<WeightedResponse> responses_around(const IntegralImage& integral,
                                               const Keypoint& keypoint)
{
    const float scale = scale_of_mask(keypoint.size);
    const auto weights = gaussian_weights();
    std::vector<WeightedResponse> responses;
    responses.reserve(kSamples * kSamples);
    for (std::size_t row = 0; row < kSamples; ++row)
        for (std::size_t column = 0; column < kSamples; ++column)
        {
            const float u = sample_offset(column);
            const float v = sample_offset(row);
            if (u * u + v * v > kRadius * kRadius) continue;
            const auto haar = haar_response(
                integral, keypoint.x + scale * u, keypoint.y + scale * v, scale * kWaveletSide);
            if (haar.dx == 0 && haar.dy == 0) continue;
            const float weight = weights[row] * weights[column];
            responses.push_back(
                {angle_of(haar.dx, haar.dy), cv::Vec2d(weight * haar.dx, weight * haar.dy)});
        }
    std::stable_sort(responses.begin(),
                     responses.end(),
                     [](const auto& a, const auto& b) { return a.angle < b.angle; });
    return responses;
}
}  // namespace

float dominant_orientation(const IntegralImage& integral, const Keypoint& keypoint)
{
    // Twice round the circle, so that a window that begins at any response ends after it.
    auto responses = responses_around(integral, keypoint);
    const auto count = responses.size();
    for (std::size_t i = 0; i < count; ++i)
        responses.push_back({responses[i].angle + kTwoPi, responses[i].gradient});
    std::vector<cv::Vec2d> sum_before(1);  // entry i: all gradients before response i
    for (const auto& response : responses)
        sum_before.push_back(sum_before.back() + response.gradient);

    cv::Vec2d longest(0, 0);
    std::size_t last = 0;
    for (std::size_t first = 0; first < count; ++first)
    {
        while (last < first + count && responses[last].angle < responses[first].angle + kWindow)
            ++last;
        const cv::Vec2d sum = sum_before[last] - sum_before[first];
        if (sum.dot(sum) > longest.dot(longest)) longest = sum;
    }
    return angle_of(longest[0], longest[1]);
}

}  // namespace fild
