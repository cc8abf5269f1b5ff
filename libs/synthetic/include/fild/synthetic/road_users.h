// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/route.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fild
{
enum class RoadUserKind
{
    pedestrian,
    car,
    lorry,
    bus
};

/** Someone in the streets at one moment. Value type. */
struct RoadUser
{
    RoadUserKind kind = RoadUserKind::pedestrian;
    double x = 0;  ///< m, of the middle
    double y = 0;
    double heading = 0;  ///< rad, from x towards y
    double stride = 0;  ///< of a pedestrian: share of two steps that is done; 0: stands
    std::uint64_t seed = 0;  ///< of the looks
};

/** Who is in the streets while the robot drives: pedestrians on the pavements, who walk or stand,
 *  and vehicles in the lane beside the robot's (oncoming, or overtaken where the robot drives on
 * the left) and before it. Vehicles keep clear of the robot and of each other. Other people and
 *  vehicles in each lap. Const members may run concurrently. */
class RoadUsers
{
 public:
    /** \param density  [0, 1]; 0: nobody; 1: a pedestrian every 5 m of pavement, every 5 s a
     * vehicle beside the robot, every 14 s one that it comes close to, where there is room for
     * them. \param route  of plan_route(). Deterministic by seed. */
    RoadUsers(double density,
              const std::vector<RoutePose>& route,
              const StreetGrid& grid,
              std::uint64_t seed);
    ~RoadUsers();
    RoadUsers(const RoadUsers&) = delete;
    RoadUsers& operator=(const RoadUsers&) = delete;

    /** All within 100 m of the robot at a frame of the route. */
    std::vector<RoadUser> at(std::size_t frame) const;

 private:
    struct Plan;
    std::unique_ptr<const Plan> plan_;
};

}  // namespace fild
