// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <algorithm>
#include <cmath>

namespace fild::testing
{
/** Cosine of the angle between two maps of one size, as vectors. */
inline double cosine(const cv::Mat& a, const cv::Mat& b)
{
    CV_Assert(a.total() == b.total() && a.total() > 0);
    double products = 0;
    double squares_of_a = 0;
    double squares_of_b = 0;
    for (std::size_t i = 0; i < a.total(); ++i)
    {
        const double x = a.ptr<float>()[i];
        const double y = b.ptr<float>()[i];
        products += x * y;
        squares_of_a += x * x;
        squares_of_b += y * y;
    }
    return products / std::sqrt(squares_of_a * squares_of_b);
}

inline bool are_same(const cv::Mat& a, const cv::Mat& b)
{
    return a.total() == b.total() &&
           std::equal(a.ptr<float>(), a.ptr<float>() + a.total(), b.ptr<float>());
}

}  // namespace fild::testing
