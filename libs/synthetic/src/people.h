// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_frame.h"
#include "textured_mesh.h"

namespace fild
{
/** The picture of everybody's clothes, faces and hair. */
cv::Mat paint_people();

/** Someone on the pavement. \param mesh  of paint_people().
 *  \param stride  how far a step is done: the legs swing as its sine, [0, 1); 0: stands. */
void add_person(TexturedMesh& mesh, const StandingObject& person, double stride);

}  // namespace fild
