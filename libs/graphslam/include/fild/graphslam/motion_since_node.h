// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"
#include "fild/mapping/trajectory_builder.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
/** How the robot moved since the last node of a graph that grows while it drives, with the sources
 *  and the covariance of TrajectoryBuilder, but not GPS. What lies before the node is forgotten, so
 *  that memory grows only with the readings since. Deterministic. Not thread-safe: one
 *  caller at a time. */
class MotionSinceNode
{
 public:
    /** \throw std::invalid_argument on bad options, and when they leave out odometry. */
    explicit MotionSinceNode(const TGraphOptions& options);

    /** To be called for every entry of a rawlog, in its order. */
    void feed(const mrpt::obs::CActionCollection& actions);

    /** \return true when there is a new reading; the first one is where the first node stands.
     *  \throw std::runtime_error when the odometry was reset, or jumped: how the robot moved is
     *         unknown. */
    bool feed(const std::shared_ptr<mrpt::obs::CObservation>& observation);

    /** From the last node to the last reading; nothing before the second reading. */
    const std::optional<RelativeMotion>& motion() const { return motion_; }

    /** Of the last reading, seconds since the UNIX epoch; 0 before the first. */
    double timestamp() const { return timestamp_; }

    /** A node stands where the last reading was. */
    void begin_at_node();

 private:
    TGraphOptions options_;
    std::unique_ptr<TrajectoryBuilder> builder_;
    std::shared_ptr<mrpt::obs::CObservation> last_reading_;
    std::size_t readings_ = 0;  ///< of builder_
    std::optional<RelativeMotion> motion_;
    double timestamp_ = 0;
};

}  // namespace fild
