// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/CSetOfTexturedTriangles.h>

#include <cstdint>

namespace fild
{
constexpr double kSkyRadius = 400;  ///< m around the camera

/** The inside of a dome with clouds by `seed`, around the origin. */
mrpt::opengl::CSetOfTexturedTriangles::Ptr sky_dome(std::uint64_t seed);

}  // namespace fild
