// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_frame.h"
#include "textured_mesh.h"

namespace fild
{
/** The picture of all wheels. */
cv::Mat paint_wheels();

/** Where a wheel is on a vehicle. */
struct WheelPlace
{
    double ahead = 0;  ///< m, of the vehicle's middle
    double left = 0;  ///< m, of the outer side of the tyre
    double radius = 0;  ///< m
};

/** A wheel of the kind and angle that the lot draws. \param mesh  of paint_wheels(). */
void add_wheel(
    TexturedMesh& mesh, const PlaceFrame& frame, const WheelPlace& place, int kind, double turned);
constexpr int kWheelKinds = 16;

}  // namespace fild
