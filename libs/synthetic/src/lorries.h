// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_frame.h"
#include "textured_mesh.h"

namespace fild
{
constexpr double kLorryLength = 6.5;  ///< m
constexpr double kLorryWidth = 2.1;  ///< m

enum class LorryKind
{
    delivery,  ///< a cab and a high box with lettering
    bus  ///< windows all along
};

/** The picture of all delivery lorries and buses. */
cv::Mat paint_lorries();

/** One of them on the road. \param bodies  of paint_lorries(). \param wheels  of paint_wheels(). */
void add_lorry(TexturedMesh& bodies,
               TexturedMesh& wheels,
               const StandingObject& lorry,
               LorryKind kind);

}  // namespace fild
