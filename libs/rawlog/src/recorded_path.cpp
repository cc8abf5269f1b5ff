// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/recorded_path.h"

#include "fild/core/geodetic.h"
#include "fild/rawlog/motion_readings.h"
#include "fild/rawlog/rawlog_reader.h"

#include <mrpt/core/Clock.h>
#include <mrpt/math/CQuaternion.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
using mrpt::math::TPoint3D;
using Source = RecordedPath::Source;

/** Turns fixes into metres east and north of the first one. */
class LocalPlane
{
 public:
    TPoint3D east_north(const GeodeticPosition& fix)
    {
        if (!plane_) plane_.emplace(fix);
        const auto position = plane_->position_of(fix);
        return {position[0], position[1], 0};
    }

 private:
    std::optional<EastNorthUp> plane_;
};

/** Nothing where the pose is not known: NaN. */
std::optional<StampedPose> robot_pose(const mrpt::obs::CObservationRobotPose& observation,
                                      double seconds)
{
    const auto& pose = observation.pose.mean;
    if (!std::isfinite(pose.x() + pose.y() + pose.z() + pose.yaw() + pose.pitch() + pose.roll()))
        return std::nullopt;
    mrpt::math::CQuaternionDouble q;
    pose.getAsQuaternion(q);
    return StampedPose{seconds, pose.x(), pose.y(), pose.z(), q.x(), q.y(), q.z(), q.r()};
}

/** Sorts observations into the paths of the sensors. */
class PathCollector
{
 public:
    /** Passes over observations without a time stamp: they cannot be placed. */
    void take(const mrpt::obs::CObservation& observation)
    {
        if (observation.timestamp == INVALID_TIMESTAMP) return;
        const double seconds = mrpt::Clock::toDouble(observation.timestamp);
        const auto* robot = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation);
        if (robot != nullptr)
            if (const auto pose = robot_pose(*robot, seconds))
                path(Source::robot_pose, observation).push_back(*pose);
        if (const auto fix = gps_fix_of(observation))
        {
            const auto place = planes_[observation.sensorLabel].east_north(fix->place);
            path(Source::gps, observation).push_back({seconds, place.x, place.y, 0});
        }
    }

    /** All paths there are, of sensors in alphabetical order. */
    std::vector<RecordedPath> paths() const
    {
        std::vector<RecordedPath> all;
        all.reserve(paths_.size());
        for (const auto& [sensor, poses] : paths_)
            all.push_back({sensor.second, sensor.first, poses});
        return all;
    }

 private:
    std::vector<StampedPose>& path(Source source, const mrpt::obs::CObservation& observation)
    {
        return paths_[{observation.sensorLabel, source}];
    }

    std::map<std::pair<std::string, Source>, std::vector<StampedPose>> paths_;
    std::map<std::string, LocalPlane> planes_;
};

std::string list_of(const std::vector<RecordedPath>& paths)
{
    std::string list;
    for (const auto& path : paths)
        list += (list.empty() ? "'" : ", '") + path.sensor_label +
                (path.source == Source::gps ? "' (GPS)" : "' (robot poses)");
    return list;
}
}  // namespace

RecordedPath read_recorded_path(const std::string& rawlog_path, const std::string& sensor_label)
{
    RawlogReader reader(rawlog_path);
    PathCollector collector;
    while (const auto observation = reader.next()) collector.take(*observation);
    auto paths = collector.paths();
    if (paths.empty())
        throw std::runtime_error(rawlog_path +
                                 " holds neither CObservationRobotPose nor CObservationGPS with a "
                                 "fix in a GGA message");
    const auto all = list_of(paths);
    const auto is_other = [&](const RecordedPath& path)
    { return !sensor_label.empty() && path.sensor_label != sensor_label; };
    paths.erase(std::remove_if(paths.begin(), paths.end(), is_other), paths.end());
    if (paths.empty())
        throw std::runtime_error(rawlog_path + " has no path of sensor '" + sensor_label +
                                 "'; there are " + all);
    if (paths.size() > 1)
        throw std::runtime_error(rawlog_path +
                                 " has several paths, name the sensor of one: " + all);
    auto& poses = paths.front().poses;
    std::stable_sort(poses.begin(),
                     poses.end(),
                     [](const StampedPose& a, const StampedPose& b)
                     { return a.seconds < b.seconds; });
    return std::move(paths.front());
}

}  // namespace fild
