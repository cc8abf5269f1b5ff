// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gps_track.h"

#include <map>
#include <string>
#include <vector>

namespace fild
{
/** What all receivers of a recording measured. Value type. */
struct GpsRecord
{
    GeodeticPosition origin;  ///< of the map
    std::vector<GpsTrack> tracks;  ///< those with the most certain positions first
};

/** Gathers the fixes of all receivers. Not thread-safe: one caller at a time. */
class GpsRecorder
{
 public:
    explicit GpsRecorder(const TGraphOptions& options) : options_(options) {}

    /** Passes over all but CObservationGPS. */
    void feed(const mrpt::obs::CObservation& observation);

    /** A camera frame at its place among the observations. */
    void add_frame(FrameId frame, double timestamp);

    /** The map's origin is the first plausible fix of the best receiver; (0, 0) when no receiver
     *  has one. A receiver is there even if it never had a fix. */
    GpsRecord build() const;

 private:
    struct Sensor
    {
        GpsReceiver receiver;
        std::vector<AwaitedFrame> frames;  ///< and how many fixes there were before each
    };

    TGraphOptions options_;
    std::map<std::string, Sensor> sensors_;  ///< by name
    std::vector<AwaitedFrame> frames_;  ///< before any fix
};

}  // namespace fild
