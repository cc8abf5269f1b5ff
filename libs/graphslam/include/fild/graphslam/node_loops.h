// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"
#include "fild/mapping/trajectory_builder.h"
#include "fild/stream/loop_closure_stream.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
/** A node of a graph that somebody else makes. */
enum class NodeId : std::uint64_t
{
};

/** A loop closure between two frames as a motion between the nodes next to them. Value type. */
struct NodeLoop
{
    FrameId candidate{};
    FrameId query{};
    NodeId candidate_node{};
    NodeId query_node{};  ///< came after candidate_node
    RelativeMotion motion;  ///< a: candidate_node, b: query_node
};

/** What became of the camera frames. Value type. */
struct NodeLoopReport
{
    std::size_t camera_frames = 0;
    std::size_t loop_closures = 0;  ///< accepted by the detector
    /** Of these, without an edge, by reason: a word of NoMetricPose, `singular_covariance`,
     *  `frame_without_pose` (the odometry says nothing of how the robot came from a node to the
     *  frame), `same_node` (no two nodes are next to the frames), `against_odometry` (rules the
     *  loop out, see TGraphOptions::odometry_confidence). */
    std::map<std::string, std::size_t> withheld;
};

/** Visual loop closures as edges between nodes that somebody else chooses, such as an engine that
 *  builds a pose graph while the robot drives.
 *
 *  A loop is measured between two frames; each gets the node that is nearest to it in time, of the
 *  one before it and the one after. The edge is node -> candidate -> query -> node, the first and
 *  the last by odometry, nothing where node and frame have one time stamp; the covariances are
 *  composed to first order, taken as independent. What is not measured makes no edge: without a
 *  metric pose, or without odometry between a node and its frame.
 *  A loop that disagrees with the odometry between its nodes is left out. Time grows with the
 *  number of readings and frames for each call of take_settled() that has loops to give.
 *  Deterministic. Not thread-safe: one caller at a time. */
class NodeLoops
{
 public:
    /** \param rawlog_path  as for LoopClosureStream.
     *  \throw std::runtime_error as LoopClosureStream, std::invalid_argument on bad options and
     *         when [relative_pose] is not enabled: no loop could ever be an edge. */
    NodeLoops(const TLoopClosureStreamOptions& stream_options,
              const TGraphOptions& graph_options,
              const std::string& rawlog_path = "");

    /** To be called for every entry of a rawlog, in its order. */
    void feed(const mrpt::obs::CActionCollection& actions);
    void feed(const mrpt::obs::CObservation& observation);

    /** A node that stands where the robot was at a time, in the order of the entries; to be called
     *  before feed() of an observation of the same time, or after it. */
    void add_node(NodeId node, double timestamp);

    /** The loops, in the order of their queries, whose nodes are known: there is a node after the
     *  query. Each is given once. */
    std::vector<NodeLoop> take_settled();

    /** All that are left, when no node will come any more. */
    std::vector<NodeLoop> take_all();

    const NodeLoopReport& report() const { return report_; }

 private:
    /** A time at which the robot's pose can be asked for. */
    struct Moment
    {
        FrameId id{};  ///< in trajectory_
        double timestamp = 0;
    };
    struct Node
    {
        NodeId id{};
        Moment moment;
    };
    struct SeenFrame
    {
        Moment moment;
        std::size_t nodes_before = 0;
    };
    /** A loop that waits for its nodes. */
    struct MeasuredLoop
    {
        FrameId candidate{};
        FrameId query{};
        RelativeMotion motion;
    };

    void add(const FedFrame& fed);
    Moment add_moment(double timestamp);
    void add_outcome(const DetectorOutcome& outcome);
    const Node& nearest_node(FrameId frame) const;
    std::vector<NodeLoop> settle(const std::vector<MeasuredLoop>& loops);
    std::optional<NodeLoop> settle(const MeasuredLoop& loop, const Trajectory& trajectory);
    bool is_against_odometry(const RelativeMotion& loop, const RelativeMotion& odometry) const;

    TGraphOptions graph_options_;
    LoopClosureStream stream_;
    TrajectoryBuilder trajectory_;
    std::vector<Node> nodes_;
    std::map<FrameId, SeenFrame> frames_;
    std::vector<MeasuredLoop> waiting_;
    NodeLoopReport report_;
};

}  // namespace fild
