// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mrpt::obs
{
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
/** The sensor's label, as UTF-8. */
std::string label_of(const mrpt::obs::CObservation& observation);

/** As notes and reports name the sensor: "CObservationOdometry 'ODOMETRY'". */
std::string name_of(const mrpt::obs::CObservation& observation);

}  // namespace fild
