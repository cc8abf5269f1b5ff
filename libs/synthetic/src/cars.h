// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_frame.h"
#include "textured_mesh.h"

namespace mrpt::opengl
{
class COpenGLScene;
}

namespace fild
{
/** One car on the road. \param bodies  of paint_cars(). \param wheels  of paint_wheels(). */
void add_car(TexturedMesh& bodies, TexturedMesh& wheels, const StandingObject& car);

void add_cars(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& cars);

}  // namespace fild
