// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/engine_run.h"

#include "fild/core/whole_file.h"
#include "fild/graph/trajectory_files.h"
#include "fild/graphslam/decider_options.h"
#include "fild/graphslam/odometry_nrd.h"
#include "fild/graphslam/visual_loop_erd.h"
#include "fild/job/interruption.h"
#include "fild/job/output_folder.h"
#include "fild/job/progress_line.h"
#include "fild/rawlog/rawlog_reader.h"
#include "mrpt_engine.h"

#include <opencv2/core/utility.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
constexpr const char* kGraphFile = "poses.graph";
constexpr const char* kTrajectoryFile = "trajectory.tum";

/** The information of an edge about an error in the tangent at its mean, which is what MRPT 2.5's
 *  optimiser multiplies it with; an edge's own is about x, y (z), yaw (pitch, roll). */
template <class Constraint>
auto information_in_tangent(const Constraint& edge)
{
    using Pose = typename Constraint::type_value;
    using Lie = mrpt::poses::Lie::SE<Pose::rotation_dimensions>;
    constexpr int kSize = static_cast<int>(Constraint::state_length);
    constexpr double kStep = 1e-6;  // m and rad
    mrpt::math::CMatrixFixed<double, kSize, kSize> by_tangent;  // derivative of the parameters
    for (int k = 0; k < kSize; ++k)
    {
        typename Lie::tangent_vector step;
        step.fill(0);
        step[k] = kStep;
        const Pose after = edge.mean + Lie::exp(step);
        step[k] = -kStep;
        const Pose before = edge.mean + Lie::exp(step);
        for (int i = 0; i < kSize; ++i)
        {
            const bool is_angle = i >= static_cast<int>(Pose::rotation_dimensions);
            const auto index = static_cast<unsigned int>(i);
            const double change = after[index] - before[index];
            by_tangent(i, k) = (is_angle ? mrpt::math::wrapToPi(change) : change) / (2 * kStep);
        }
    }
    return mrpt::math::CMatrixFixed<double, kSize, kSize>(
        by_tangent.asEigen().transpose() * edge.cov_inv.asEigen() * by_tangent.asEigen());
}

/** MRPT's optimiser, which can be asked for the whole graph and keeps its times to itself. */
template <class Graph>
class CWholeGraphGSO : public mrpt::graphslam::optimizers::CLevMarqGSO<Graph>
{
 public:
    CWholeGraphGSO() { this->m_time_logger.disable(); }

    /** MRPT's optimiser takes a step only when it reduces the squared error without information. A
     *  damped step follows the error with information, and may not: with the damping that it
     *  begins with by itself it gives up at once where most of the error is in few edges. So it
     *  begins with next to none. */
    void optimizeWholeGraph() const
    {
        constexpr double kLittleDamping = 1e-3;
        auto graph = *this->m_graph;
        for (auto& edge : graph.edges) edge.second.cov_inv = information_in_tangent(edge.second);
        auto options = this->opt_params.cfg;
        options["initial_lambda"] = kLittleDamping;
        mrpt::graphslam::TResultInfoSpaLevMarq result{};
        mrpt::graphslam::optimize_graph_spa_levmarq(graph, result, nullptr, options);
        this->m_graph->nodes = graph.nodes;
    }
};

/** MRPT's engine, which keeps its times to itself. */
template <class Graph>
class CSilentEngine : public mrpt::graphslam::CGraphSlamEngine<Graph>
{
 public:
    template <class... Arguments>
    explicit CSilentEngine(const Arguments&... arguments)
        : mrpt::graphslam::CGraphSlamEngine<Graph>(arguments...)
    {
        this->m_time_logger.disable();
    }
};

/** Nothing reaches std::cout while this lives: what engine and optimiser say before they have read
 *  class_verbosity. */
class SilentOutput
{
 public:
    SilentOutput() : shown_(std::cout.rdbuf(nullptr)) {}
    SilentOutput(const SilentOutput&) = delete;
    SilentOutput& operator=(const SilentOutput&) = delete;
    ~SilentOutput() { std::cout.rdbuf(shown_); }

 private:
    std::streambuf* shown_;
};

/** The engine with its deciders. */
template <class Graph>
class EngineRun
{
 public:
    explicit EngineRun(const EngineRequest& request)
        : request_(request),
          visual_(request.rawlog),
          engine_(request.config,
                  request.rawlog,
                  std::string(),
                  kNoWindow,
                  &nodes_,
                  request.with_loops ? static_cast<EdgeDecider*>(&visual_) : &none_,
                  &optimizer_)
    {
    }

    EngineResult run(const OutputFolder& folder)
    {
        read_rawlog();
        const auto& graph = engine_.getGraph();
        if (graph.nodeCount() == 0)
            throw std::runtime_error(request_.rawlog +
                                     ": no graph, for no odometry tells that the robot moved by "
                                     "registration_max_distance or registration_max_angle");
        if (request_.with_loops) visual_.finish();
        optimizer_.optimizeWholeGraph();
        write(folder);
        EngineResult result;
        result.nodes = graph.nodeCount();
        result.loop_edges = visual_.numRegisteredLoops();
        result.odometry_edges = graph.edgeCount() - result.loop_edges;
        if (request_.with_loops) result.withheld = visual_.report().withheld;
        return result;
    }

 private:
    /** Those of the rawlog that the engine is given. */
    struct Entries
    {
        mrpt::obs::CActionCollection::Ptr actions;  ///< of the next step; none: it has no actions
        mrpt::obs::CSensoryFrame::Ptr observations;  ///< after them
        std::size_t count = 0;
    };
    static constexpr mrpt::graphslam::CWindowManager* kNoWindow = nullptr;
    using EdgeDecider = mrpt::graphslam::deciders::CEdgeRegistrationDecider<Graph>;

    int max_entry_megabytes() const
    {
        const auto* const section = request_.with_loops ? "EdgeRegistrationDeciderParameters"
                                                        : "NodeRegistrationDeciderParameters";
        return load_decider_options(request_.config, section).stream.input.max_entry_megabytes;
    }

    void read_rawlog()
    {
        RawlogReader reader(request_.rawlog, max_entry_megabytes());
        // Without images it is a matter of seconds.
        ProgressLine progress(request_.quiet || !request_.with_loops, "loop edges");
        while (true)
        {
            throw_if_interrupted();
            auto [observation, actions] = reader.next_entry();
            if (!observation && !actions) break;
            take(std::move(observation), actions);
            if (request_.with_loops)
                progress.update(reader.fraction_read(),
                                visual_.report().camera_frames,
                                visual_.numRegisteredLoops());
        }
        step_with_actions();
    }

    /** Observations are a step each; actions are one with the observations up to the next ones. */
    void take(mrpt::obs::CObservation::Ptr observation,
              const mrpt::obs::CActionCollection::Ptr& actions)
    {
        if (actions && actions->size() > 0)
        {
            step_with_actions();
            entries_.actions = actions;
            entries_.observations = mrpt::obs::CSensoryFrame::Create();
        }
        else if (observation && entries_.actions)
            entries_.observations->insert(observation);
        else if (observation)
            engine_.execGraphSlamStep(observation, entries_.count);
    }

    void step_with_actions()
    {
        if (!entries_.actions) return;
        mrpt::obs::CObservation::Ptr none;
        engine_._execGraphSlamStep(entries_.actions, entries_.observations, none, entries_.count);
        entries_.actions.reset();
    }

    void write(const OutputFolder& folder) const
    {
        const auto& graph = engine_.getGraph();
        for (const auto* name : {kGraphFile, kTrajectoryFile})  // of an earlier run: no mixed set
            std::filesystem::remove(folder.file(name));
        WholeFile file(folder.file(kGraphFile));
        // As many digits as a number has: information may be nearly singular.
        file.stream().precision(std::numeric_limits<double>::max_digits10);
        graph.writeAsText(file.stream());
        std::vector<TrajectoryPose> poses;
        const auto& timestamps = nodes_.getNodeTimestamps();
        for (const auto& [id, pose] : graph.nodes)
            poses.push_back({FrameId{id}, timestamps.at(id), mrpt::poses::CPose3D(pose), 0});
        write_trajectory(folder.file(kTrajectoryFile), poses, TrajectoryFormat::tum);
        file.commit();
    }

    EngineRequest request_;
    COdometryNRD<Graph> nodes_;
    CVisualLoopERD<Graph> visual_;
    mrpt::graphslam::deciders::CEmptyERD<Graph> none_;
    CWholeGraphGSO<Graph> optimizer_;
    CSilentEngine<Graph> engine_;
    Entries entries_;
};

template <class Graph>
EngineResult run_graph(const EngineRequest& request, const OutputFolder& folder)
{
    std::unique_ptr<EngineRun<Graph>> run;
    {
        const SilentOutput silence;
        run = std::make_unique<EngineRun<Graph>>(request);
    }
    return run->run(folder);
}
}  // namespace

EngineResult run_engine(const EngineRequest& request)
{
    catch_interruption();
    cv::setNumThreads(1);  // our own threads are enough, and OpenCV's may not repeat
    // Before the network is loaded and hours are spent.
    const RawlogReader checked(request.rawlog);
    const OutputFolder folder(request.output);
    // MRPT 2.5's engine takes no class of graph for a tested one, and waits for a key.
    if (std::freopen("/dev/null", "r", stdin) == nullptr)
        throw std::runtime_error("cannot open /dev/null");
    try
    {
        if (request.dimensions == GraphDimensions::planar)
            return run_graph<mrpt::graphs::CNetworkOfPoses2DInf>(request, folder);
        return run_graph<mrpt::graphs::CNetworkOfPoses3DInf>(request, folder);
    }
    catch (const mrpt::ExceptionWithCallBackBase& error)
    {
        throw std::runtime_error(error.originalWhat);  // the user has no use for MRPT's call stack
    }
}

}  // namespace fild
