// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/random.h"

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/poses/CPose3D.h>

#include <random>

namespace fild::testing
{
/** Any position within some metres; any yaw, pitch and roll up to `max_tilt` radians. */
inline mrpt::poses::CPose3D random_pose(std::mt19937_64& generator, double max_tilt = 1.4)
{
    const auto normal = [&] { return standard_normal(generator); };
    const auto tilt = [&] { return max_tilt * std::tanh(normal()); };
    return {3 * normal(), 3 * normal(), normal(), 2 * normal(), tilt(), tilt()};
}

/** Any position within some metres; yaw, pitch and roll up to 0.3 rad. Where MRPT's composition of
 *  uncertain poses passes a half turn, its quaternion changes sign and its covariances between
 *  positions and angles do so wrongly; far from that it can be compared with. */
inline mrpt::poses::CPose3D moderate_pose(std::mt19937_64& generator)
{
    const auto normal = [&] { return standard_normal(generator); };
    const auto angle = [&] { return 0.3 * std::tanh(normal()); };
    return {3 * normal(), 3 * normal(), normal(), angle(), angle(), angle()};
}

/** A full matrix, positive definite. */
inline mrpt::math::CMatrixDouble66 random_information(std::mt19937_64& generator)
{
    mrpt::math::CMatrixDouble66 root;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) root(row, column) = standard_normal(generator);
    mrpt::math::CMatrixDouble66 information;
    information.matProductOf_AAt(root);
    for (int i = 0; i < 6; ++i) information(i, i) += 5;
    return information;
}

}  // namespace fild::testing
