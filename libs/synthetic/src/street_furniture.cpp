// SPDX-License-Identifier: BSD-3-Clause
#include "street_furniture.h"

#include "solids.h"

#include <mrpt/opengl/COpenGLScene.h>

namespace fild
{
void add_lamp_posts(mrpt::opengl::COpenGLScene& scene,
                    const std::vector<StandingObject>& lamp_posts)
{
    TexturedMesh posts;
    for (const auto& place : lamp_posts)
    {
        const PlaceFrame frame(place, kKerbHeight);
        add_post(posts, frame, {0, 0}, {0, 0.9}, 0.12, 8);
        add_post(posts, frame, {0, 0}, {0.9, 4.6}, 0.06, 8);
        add_post(posts, frame, {0, 0}, {4.6, 5.1}, 0.2, 6);
        add_post(posts, frame, {0, 0}, {5.1, 5.2}, 0.28, 6);
    }
    Lot lot(63);
    scene.insert(posts.object(paint_mottled({64, 256}, {62, 66, 60}, 0.15, lot)));
}

}  // namespace fild
