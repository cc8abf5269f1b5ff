// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_content.h"

#include <mrpt/opengl/COpenGLScene.h>

namespace fild
{
/** Where the marks of start and end stand. */
cv::Vec3d start_mark(const MapContent& map);
cv::Vec3d end_mark(const MapContent& map);

/** The scene of a map, without text. */
mrpt::opengl::COpenGLScene::Ptr make_scene(const MapContent& map);

}  // namespace fild
