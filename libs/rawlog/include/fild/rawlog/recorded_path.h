// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/recording.h"

#include <string>
#include <vector>

namespace fild
{
/** Where the robot was by one of its sensors. */
struct RecordedPath
{
    enum class Source
    {
        robot_pose,  ///< CObservationRobotPose
        gps  ///< GGA messages of CObservationGPS: no orientation, quaternions are the identity
    };

    Source source = Source::robot_pose;
    std::string sensor_label;
    std::vector<StampedPose> poses;  ///< in the order of time
};

/** Reads the robot's path out of a rawlog. Positions of a GPS are metres east and north of its
 *  first fix in the plane that touches the WGS 84 ellipsoid there; z is 0, as its heights are too
 *  coarse. Messages without a fix are passed over. Where on the robot the antenna is is not taken
 *  into account.
 *  \param sensor_label  whose path; empty: of the only sensor with one.
 *  \throw std::runtime_error as RawlogReader, or when there is no such path or, without a label,
 *         more than one (naming them: odometry may be recorded as robot poses too). */
RecordedPath read_recorded_path(const std::string& rawlog_path, const std::string& sensor_label);

}  // namespace fild
