// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/road_users.h"
#include "textured_mesh.h"

#include <vector>

namespace mrpt::opengl
{
class COpenGLScene;
}

namespace fild
{
/** Pedestrians and vehicles of one moment, as objects of a scene. */
class RoadUserScene
{
 public:
    /** Paints them all, which takes half a second. */
    RoadUserScene();

    /** Makes them part of a scene. */
    void insert_into(mrpt::opengl::COpenGLScene& scene) const;

    /** Replaces those that are shown. */
    void show(const std::vector<RoadUser>& users);

 private:
    /** Surfaces that change, and the object that shows them. */
    struct Shown
    {
        explicit Shown(const cv::Mat& picture) : object(mesh.object(picture)) {}

        TexturedMesh mesh;
        mrpt::opengl::CSetOfTexturedTriangles::Ptr object;
    };
    Shown people_;
    Shown cars_;
    Shown lorries_;
    Shown wheels_;
};

}  // namespace fild
