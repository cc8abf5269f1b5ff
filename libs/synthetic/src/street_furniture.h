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
void add_lamp_posts(mrpt::opengl::COpenGLScene& scene,
                    const std::vector<StandingObject>& lamp_posts);

}  // namespace fild
