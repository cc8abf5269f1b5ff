// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/road_users.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fild
{
/** A vehicle that the robot meets: its way along the robot's lane over time. Value type. */
struct Encounter
{
    RoadUserKind kind = RoadUserKind::car;
    bool is_ahead = false;  ///< drives before the robot, lets it come near and drives off
    double seconds = 0;  ///< when it is beside the robot, or closest before it
    double metres = 0;  ///< along the robot's lane, where it is then
    double speed = 0;  ///< m/s along the lane; negative: against it; unused when it is ahead
    double left = 0;  ///< m beside the middle of the right-hand lane
    std::uint64_t seed = 0;
};

/** Length and width of a vehicle, m. */
cv::Size2d size_of(RoadUserKind kind);

/** Vehicles beside and before a robot on its route. */
class LaneTraffic
{
 public:
    LaneTraffic() = default;
    /** \param density, route, seed  as in RoadUsers. */
    LaneTraffic(double density, const std::vector<RoutePose>& route, std::uint64_t seed);

    std::vector<RoadUser> at(std::size_t frame) const;
    const std::vector<Encounter>& encounters() const { return encounters_; }

 private:
    std::vector<RoutePose> route_;
    std::vector<Encounter> encounters_;
};

}  // namespace fild
