// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "town_plan.h"

#include <vector>

namespace mrpt::opengl
{
class COpenGLScene;
}

namespace fild
{
void add_trees(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& trees);
void add_lamp_posts(mrpt::opengl::COpenGLScene& scene,
                    const std::vector<StandingObject>& lamp_posts);
void add_cars(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& cars);

}  // namespace fild
