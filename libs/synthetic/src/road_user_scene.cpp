// SPDX-License-Identifier: BSD-3-Clause
#include "road_user_scene.h"

#include "car_models.h"
#include "cars.h"
#include "lorries.h"
#include "people.h"
#include "wheels.h"

#include <mrpt/opengl/COpenGLScene.h>

namespace fild
{
RoadUserScene::RoadUserScene()
    : people_(paint_people()),
      cars_(paint_cars()),
      lorries_(paint_lorries()),
      wheels_(paint_wheels())
{
}

void RoadUserScene::insert_into(mrpt::opengl::COpenGLScene& scene) const
{
    for (const auto* shown : {&people_, &cars_, &lorries_, &wheels_}) scene.insert(shown->object);
}

void RoadUserScene::show(const std::vector<RoadUser>& users)
{
    for (auto* shown : {&people_, &cars_, &lorries_, &wheels_}) shown->mesh.clear();
    for (const auto& user : users)
    {
        const StandingObject place{{user.x, user.y}, user.heading, user.seed};
        switch (user.kind)
        {
            case RoadUserKind::pedestrian:
                add_person(people_.mesh, place, user.stride);
                break;
            case RoadUserKind::car:
                add_car(cars_.mesh, wheels_.mesh, place);
                break;
            case RoadUserKind::lorry:
                add_lorry(lorries_.mesh, wheels_.mesh, place, LorryKind::delivery);
                break;
            case RoadUserKind::bus:
                add_lorry(lorries_.mesh, wheels_.mesh, place, LorryKind::bus);
                break;
        }
    }
}

}  // namespace fild
