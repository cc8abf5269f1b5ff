// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/matx.hpp>

#include <Eigen/Geometry>

namespace fild
{
inline Eigen::Vector3d to_eigen(const cv::Vec3d& v)
{
    return {v[0], v[1], v[2]};
}

inline Eigen::Matrix3d to_eigen(const cv::Matx33d& m)
{
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.val);
}

inline cv::Matx33d to_opencv(const Eigen::Matrix3d& m)
{
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

}  // namespace fild
