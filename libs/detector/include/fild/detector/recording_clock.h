// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

namespace fild
{
/** The time that has passed in a recording, for the delay queue: made of the frames' time stamps,
 *  and robust against those that are wrong.
 *
 *  All cameras share one timeline; a camera's first frame is where the timeline then is. A stamp
 *  fits when it is at most 1 s older than its camera's newest one, and takes the timeline at most
 *  a limit further: 5 s, or 10 median steps of its camera if that is longer. A frame whose stamp
 *  does not fit takes the time of the frame before. So one wrong stamp does nothing, whether it is
 *  too early, too late, absent (0) or not a number. When the stamps go on from the one that did not
 *  fit for at least 1 s, the clock was set: the camera's time goes on by one median step from its
 *  newest frame that fitted, then as the new stamps do.
 *
 *  A pause of the robot for longer than the limit looks the same as a clock set forward and counts
 *  as one step, too. That is the harmless error: the delay lasts longer than it says, so that
 *  returns to places seen just before the pause are missed for a while. Taking a clock set forward
 *  for a pause would end the delay of all frames at once, and each would be found as a return to
 *  its own neighbourhood.
 *
 *  Value type. Deterministic. Not thread-safe: one caller at a time. */
class RecordingClock
{
 public:
    /** \param camera  label of the frame's camera. \param stamp  of the frame, seconds from any
     *  origin. \return seconds since the first frame; never less than for the frame before. */
    double advance(const std::string& camera, double stamp);

    /** How often a camera's stamps stopped to fit. A single wrong stamp counts once, a clock that
     *  is set and later set back twice. */
    std::size_t jumps() const { return jumps_; }

 private:
    /** The last steps between stamps of a camera, seconds. */
    class Steps
    {
     public:
        void add(double step);
        bool empty() const { return steps_.empty(); }
        /** The smaller of the middle two of an even number; 0: there are none. */
        double median() const;
        /** The longest step that is not a jump. */
        double limit() const;

     private:
        std::deque<double> steps_;
    };

    /** Stamps that do not fit, in a row that goes on. */
    struct Departure
    {
        double first = 0;  ///< stamp
        double newest = 0;  ///< stamp
        double now = 0;  ///< the timeline when it began
        Steps steps;
    };

    struct Camera
    {
        double newest = 0;  ///< stamp of those that fitted
        double offset = 0;  ///< the timeline's seconds less the stamp's
        Steps steps;
        std::optional<Departure> departure;
    };

    bool fits(const Camera& camera, double stamp) const;
    void accept(Camera& camera, double stamp);
    /** \return true when the stamps have gone on for long enough: the clock was set. */
    bool depart(Camera& camera, double stamp);
    void set_clock(Camera& camera);

    std::map<std::string, Camera> cameras_;
    double now_ = 0;
    std::size_t jumps_ = 0;
};

}  // namespace fild
