// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/render/offscreen_renderer.h"
#include "fild/synthetic/road_users.h"
#include "fild/synthetic/street_grid.h"
#include "fild/synthetic/town_options.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace fild
{
/** What differs from one lap through the town to the next, and who is in its streets. Value type.
 */
struct LapConditions
{
    double sun_azimuth = 0.8;  ///< rad, from x towards y: where the sun stands
    double sun_elevation = 0.8;  ///< rad, over the horizon, (0, pi/2)
    double exposure = 1;  ///< factor of all grey values
    std::uint64_t parked_cars = 1;  ///< seed: which cars stand where, which clouds pass
    double season = 0;  ///< of trees and ground; 0: summer; 1: late autumn
    std::vector<RoadUser> road_users{};  ///< at one moment
};

/** A town to drive through: streets, houses, trees, lamp posts, parked cars and sky, all of it
 *  painted and built from TTownOptions::seed. Deterministic. Bound to the thread that made it. */
class Town
{
 public:
    /** \throw std::invalid_argument on options out of range.
     *  \throw std::runtime_error as OffscreenRenderer. */
    explicit Town(const TTownOptions& options);
    ~Town();
    Town(const Town&) = delete;
    Town& operator=(const Town&) = delete;

    const StreetGrid& grid() const;

    /** What a camera sees; the sky has no depth. A change of conditions from call to call costs
     *  a second, one of the road users alone some milliseconds. \param camera, map_from_camera  as
     * in OffscreenRenderer::draw(). */
    RenderedView draw(const CameraModel& camera,
                      const mrpt::poses::CPose3D& map_from_camera,
                      const LapConditions& conditions);

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace fild
