// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/matx.hpp>

namespace fild
{
/** A place on the Earth, WGS 84. Value type. */
struct GeodeticPosition
{
    double latitude_deg = 0;  ///< north positive
    double longitude_deg = 0;  ///< east positive
    double height_m = 0;  ///< over the ellipsoid
};

/** Metres east, north and up of an origin: the plane that touches the WGS 84 ellipsoid there.
 *  Exact at any distance, so places far away lie below the plane. Value type. */
class EastNorthUp
{
 public:
    explicit EastNorthUp(const GeodeticPosition& origin);

    const GeodeticPosition& origin() const { return origin_; }

    cv::Vec3d position_of(const GeodeticPosition& place) const;

    /** Inverse of position_of(), to a millimetre within 100 km of the ellipsoid. */
    GeodeticPosition place_of(const cv::Vec3d& position) const;

 private:
    GeodeticPosition origin_;
    cv::Vec3d earth_from_origin_;  ///< earth-centred coordinates of the origin
    cv::Matx33d earth_from_local_;  ///< turns the axes
};

}  // namespace fild
