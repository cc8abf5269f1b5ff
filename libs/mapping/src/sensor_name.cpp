// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_name.h"

#include "fild/core/utf8.h"

#include <mrpt/obs/CObservation.h>

namespace fild
{
std::string label_of(const mrpt::obs::CObservation& observation)
{
    return as_utf8(observation.sensorLabel);
}

std::string name_of(const mrpt::obs::CObservation& observation)
{
    constexpr std::size_t kPrefix = std::char_traits<char>::length("mrpt::obs::");
    const auto label = label_of(observation);
    return std::string(observation.GetRuntimeClass()->className).substr(kPrefix) +
           (label.empty() ? "" : " '" + label + "'");
}

}  // namespace fild
