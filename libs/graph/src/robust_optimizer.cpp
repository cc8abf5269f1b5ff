// SPDX-License-Identifier: BSD-3-Clause
// Graduated non-convexity with truncated least squares (Yang et al., RA-L 2020).
#include "fild/graph/robust_optimizer.h"

#include "information.h"

#include <mrpt/math/distributions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <ceres/autodiff_cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/rotation.h>
#include <ceres/solver.h>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
/** What Ceres works on. */
struct NodeState
{
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

NodeState to_state(const mrpt::poses::CPose3D& pose)
{
    const Rigid rigid = to_rigid(pose);
    return {rigid.translation, Eigen::Quaterniond(rigid.rotation)};
}

/** Error of an edge against two poses, whitened: its squared norm is the Mahalanobis distance. */
class EdgeError
{
 public:
    /** \param weight  read at each evaluation; must outlive this. */
    EdgeError(const GraphEdge& edge, const double* weight)
        : measured_(to_state(edge.a_from_b)), weight_(weight)
    {
        const Matrix6 information =
            information_in_tangent(edge.a_from_b, edge.information, "information");
        square_root_ = Eigen::LLT<Matrix6>(information).matrixU();
    }

    template <class T>
    bool operator()(const T* a_translation,
                    const T* a_rotation,
                    const T* b_translation,
                    const T* b_rotation,
                    T* residual) const
    {
        using Vector3 = Eigen::Matrix<T, 3, 1>;
        using Quaternion = Eigen::Quaternion<T>;
        const Eigen::Map<const Vector3> a(a_translation);
        const Eigen::Map<const Vector3> b(b_translation);
        const Quaternion map_from_a = Eigen::Map<const Quaternion>(a_rotation);
        const Quaternion map_from_b = Eigen::Map<const Quaternion>(b_rotation);
        const Quaternion measured = measured_.rotation.conjugate().template cast<T>();
        const Quaternion a_from_map = map_from_a.conjugate();
        const Vector3 a_from_b = a_from_map * Vector3(b - a);
        const Quaternion turn = measured * (a_from_map * map_from_b);
        const std::array<T, 4> wxyz{turn.w(), turn.x(), turn.y(), turn.z()};
        Eigen::Matrix<T, 6, 1> error;
        error.template head<3>() =
            measured * Vector3(a_from_b - measured_.translation.template cast<T>());
        ceres::QuaternionToAngleAxis(wxyz.data(), error.data() + 3);
        Eigen::Map<Eigen::Matrix<T, 6, 1>> whitened(residual);
        whitened = (std::sqrt(*weight_) * square_root_).template cast<T>() * error;
        return true;
    }

 private:
    NodeState measured_;
    Matrix6 square_root_;
    const double* weight_;
};

/** Error of a prior against a pose, whitened. */
class PriorError
{
 public:
    /** \param weight  read at each evaluation; must outlive this. */
    PriorError(const GraphPrior& prior, const double* weight)
        : map_from_point_(to_vector(prior.map_from_point)),
          robot_from_point_(to_vector(prior.robot_from_point)),
          square_root_(Eigen::LLT<Eigen::Matrix3d>(prior.information.asEigen()).matrixU()),
          weight_(weight)
    {
    }

    template <class T>
    bool operator()(const T* translation, const T* rotation, T* residual) const
    {
        using Vector3 = Eigen::Matrix<T, 3, 1>;
        const Eigen::Map<const Vector3> robot(translation);
        const Eigen::Quaternion<T> map_from_robot =
            Eigen::Map<const Eigen::Quaternion<T>>(rotation);
        const Vector3 point = map_from_robot * robot_from_point_.template cast<T>() + robot;
        Eigen::Map<Vector3> whitened(residual);
        whitened = (std::sqrt(*weight_) * square_root_).template cast<T>() *
                   Vector3(point - map_from_point_.template cast<T>());
        return true;
    }

 private:
    static Eigen::Vector3d to_vector(const mrpt::math::TPoint3D& point)
    {
        return {point.x, point.y, point.z};
    }

    Eigen::Vector3d map_from_point_;
    Eigen::Vector3d robot_from_point_;
    Eigen::Matrix3d square_root_;
    const double* weight_;
};

const double kFullWeight = 1;

/** Ends Ceres' work when the caller cancels; Ceres itself lets no exception through. */
class CancellationCallback : public ceres::IterationCallback
{
 public:
    explicit CancellationCallback(const CheckCancelled& check) : check_(check) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override
    {
        try
        {
            check_();
            return ceres::SOLVER_CONTINUE;
        }
        catch (const std::exception&)
        {
            thrown_ = std::current_exception();
            return ceres::SOLVER_ABORT;
        }
    }

    void rethrow() const
    {
        if (thrown_) std::rethrow_exception(thrown_);
    }

 private:
    const CheckCancelled& check_;
    std::exception_ptr thrown_;
};

/** Weights, or errors, of the loops and the priors of a graph. */
struct Doubted
{
    std::vector<double> loops;
    std::vector<double> priors;
};

/** A graph in Ceres' terms, whose weights can be changed between solutions. */
class LeastSquares
{
 public:
    LeastSquares(const PoseGraph& graph,
                 const std::vector<bool>& loops_used,
                 const CheckCancelled& check_cancelled)
        : graph_(graph),
          check_cancelled_(check_cancelled),
          weights_{std::vector<double>(graph.loops.size(), 0),
                   std::vector<double>(graph.priors.size(), 1)}
    {
        states_.reserve(graph.nodes.size());
        for (const auto& node : graph.nodes) states_.push_back(to_state(node.map_from_robot));
        for (const auto& edge : graph.odometry) add(edge, &kFullWeight);
        for (std::size_t i = 0; i < graph.loops.size(); ++i)
            if (loops_used[i]) add(graph.loops[i], &weights_.loops[i]);
        for (std::size_t i = 0; i < graph.priors.size(); ++i)
            add(graph.priors[i], &weights_.priors[i]);
        fix_first_of_each_part(loops_used);
    }

    /** Goes on from where the last solution ended. */
    void solve(const Doubted& weights, int max_iterations)
    {
        std::copy(weights.loops.begin(), weights.loops.end(), weights_.loops.begin());
        std::copy(weights.priors.begin(), weights.priors.end(), weights_.priors.begin());
        ++solutions_;
        ceres::Solver::Options options;
        options.max_num_iterations = max_iterations;
        options.num_threads = 1;
        options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
        // Not SuiteSparse: its BLAS may use threads, whose sums need not repeat.
        options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
        options.function_tolerance = 1e-9;
        options.logging_type = ceres::SILENT;
        CancellationCallback cancellation(check_cancelled_);
        options.callbacks.push_back(&cancellation);
        ceres::Solver::Summary summary;
        if (problem_.NumResidualBlocks() > 0)
        {
            ceres::Solve(options, &problem_, &summary);
            cancellation.rethrow();
            if (!summary.IsSolutionUsable())
                throw std::runtime_error("the pose graph cannot be optimised: " + summary.message);
        }
        for (auto& state : states_) state.rotation.normalize();
    }

    OptimizedPoses result() const
    {
        OptimizedPoses result;
        result.map_from_robot.reserve(states_.size());
        for (const auto& state : states_)
            result.map_from_robot.push_back(
                to_pose({state.rotation.toRotationMatrix(), state.translation}));
        const auto errors = this->errors();
        result.loop_weights = weights_.loops;
        result.loop_errors = errors.loops;
        result.prior_weights = weights_.priors;
        result.prior_errors = errors.priors;
        result.optimizations = solutions_;
        return result;
    }

    Doubted errors() const
    {
        Doubted errors;
        errors.loops.reserve(graph_.loops.size());
        for (const auto& edge : graph_.loops)
            errors.loops.push_back(squared_error_of(
                edge, states_[graph_.index_of(edge.a)], states_[graph_.index_of(edge.b)]));
        errors.priors.reserve(graph_.priors.size());
        for (const auto& prior : graph_.priors)
            errors.priors.push_back(squared_error_of(prior, states_[graph_.index_of(prior.frame)]));
        return errors;
    }

    static double squared_error_of(const GraphPrior& prior, const NodeState& state)
    {
        Eigen::Vector3d residual;
        PriorError(prior, &kFullWeight)(
            state.translation.data(), state.rotation.coeffs().data(), residual.data());
        return residual.squaredNorm();
    }

    static double squared_error_of(const GraphEdge& edge, const NodeState& a, const NodeState& b)
    {
        Vector6 residual;
        EdgeError(edge, &kFullWeight)(a.translation.data(),
                                      a.rotation.coeffs().data(),
                                      b.translation.data(),
                                      b.rotation.coeffs().data(),
                                      residual.data());
        return residual.squaredNorm();
    }

 private:
    void add(const GraphEdge& edge, const double* weight)
    {
        auto& a = states_[graph_.index_of(edge.a)];
        auto& b = states_[graph_.index_of(edge.b)];
        auto cost = std::make_unique<ceres::AutoDiffCostFunction<EdgeError, 6, 3, 4, 3, 4>>(
            new EdgeError(edge, weight));
        problem_.AddResidualBlock(cost.release(),  // the problem's from here on
                                  nullptr,
                                  a.translation.data(),
                                  a.rotation.coeffs().data(),
                                  b.translation.data(),
                                  b.rotation.coeffs().data());
        for (auto* state : {&a, &b}) keep_unit_length(*state);
    }

    void add(const GraphPrior& prior, const double* weight)
    {
        auto& state = states_[graph_.index_of(prior.frame)];
        auto cost = std::make_unique<ceres::AutoDiffCostFunction<PriorError, 3, 3, 4>>(
            new PriorError(prior, weight));
        problem_.AddResidualBlock(cost.release(),  // the problem's from here on
                                  nullptr,
                                  state.translation.data(),
                                  state.rotation.coeffs().data());
        keep_unit_length(state);
    }

    void keep_unit_length(NodeState& state)
    {
        if (!problem_.HasManifold(state.rotation.coeffs().data()))
            problem_.SetManifold(state.rotation.coeffs().data(),
                                 new ceres::EigenQuaternionManifold);
    }

    void fix_first_of_each_part(const std::vector<bool>& loops_used)
    {
        PoseGraph used{graph_.nodes, graph_.odometry, {}, graph_.priors};
        for (std::size_t i = 0; i < graph_.loops.size(); ++i)
            if (loops_used[i]) used.loops.push_back(graph_.loops[i]);
        for (const auto& part : connected_parts(used))
        {
            auto& state = states_[graph_.index_of(part.front())];
            const bool has_priors =
                !graph_.priors.empty() &&
                std::binary_search(part.begin(), part.end(), graph_.priors.front().frame);
            if (has_priors || part.size() == 1) continue;  // or no edge, unknown to the problem
            problem_.SetParameterBlockConstant(state.translation.data());
            problem_.SetParameterBlockConstant(state.rotation.coeffs().data());
        }
    }

    const PoseGraph& graph_;
    const CheckCancelled& check_cancelled_;
    Doubted weights_;  ///< never resized: the residuals point at them
    std::vector<NodeState> states_;  ///< never resized, likewise
    ceres::Problem problem_;
    int solutions_ = 0;
};

constexpr double kNoWeight = 1e-3;  ///< what is below is 0, what is as near to 1 is 1

/** Eq. (14): the weight at a stage mu of the surrogate, for a squared error and its limit. */
double tls_weight(double error, double limit, double mu)
{
    if (error >= (mu + 1) / mu * limit) return 0;
    if (error <= mu / (mu + 1) * limit) return 1;
    const double weight = std::sqrt(limit * mu * (mu + 1) / error) - mu;
    return weight < kNoWeight ? 0 : std::min(weight, 1.0);
}

bool are_binary(const std::vector<double>& weights)
{
    return std::all_of(weights.begin(),
                       weights.end(),
                       [](double weight) { return weight < kNoWeight || weight > 1 - kNoWeight; });
}

/** Errors up to which loops and priors are fully trusted. */
struct ErrorLimits
{
    explicit ErrorLimits(double confidence)
        : loop(mrpt::math::chi2inv(confidence, 6)), prior(mrpt::math::chi2inv(confidence, 3))
    {
    }

    double loop;
    double prior;
};

/** The largest error of a loop that may count, or a prior, as a multiple of its limit. */
double largest_excess(const Doubted& errors,
                      const std::vector<bool>& candidates,
                      const ErrorLimits& limits)
{
    double largest = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (candidates[i]) largest = std::max(largest, errors.loops[i] / limits.loop);
    for (const double error : errors.priors) largest = std::max(largest, error / limits.prior);
    return largest;
}

/** The weights at a stage mu. */
Doubted weights_at(double mu,
                   const Doubted& errors,
                   const std::vector<bool>& candidates,
                   const ErrorLimits& limits)
{
    Doubted weights;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        weights.loops.push_back(candidates[i] ? tls_weight(errors.loops[i], limits.loop, mu) : 0);
    for (const double error : errors.priors)
        weights.priors.push_back(tls_weight(error, limits.prior, mu));
    return weights;
}

void check(const OptimizationLimits& limits)
{
    if (limits.max_iterations < 1 || !(limits.loop_confidence > 0 && limits.loop_confidence < 1))
        throw std::invalid_argument(
            "OptimizationLimits: max_iterations=" + std::to_string(limits.max_iterations) +
            " must be positive, loop_confidence=" + std::to_string(limits.loop_confidence) +
            " in (0, 1)");
}

void check_count(std::size_t given, const PoseGraph& graph)
{
    if (given != graph.loops.size())
        throw std::invalid_argument("optimize: " + std::to_string(given) + " loop weights for " +
                                    std::to_string(graph.loops.size()) + " loops");
}
}  // namespace

double squared_error(const GraphEdge& edge,
                     const mrpt::poses::CPose3D& map_from_a,
                     const mrpt::poses::CPose3D& map_from_b)
{
    return LeastSquares::squared_error_of(edge, to_state(map_from_a), to_state(map_from_b));
}

double squared_error(const GraphPrior& prior, const mrpt::poses::CPose3D& map_from_robot)
{
    return LeastSquares::squared_error_of(prior, to_state(map_from_robot));
}

OptimizedPoses optimize(const PoseGraph& graph,
                        const std::vector<double>& loop_weights,
                        const OptimizationLimits& limits,
                        const CheckCancelled& check_cancelled)
{
    graph.check();
    check(limits);
    check_count(loop_weights.size(), graph);
    std::vector<bool> used;
    used.reserve(loop_weights.size());
    for (const double weight : loop_weights)
    {
        if (!(weight >= 0 && weight <= 1))
            throw std::invalid_argument("optimize: a loop weight of " + std::to_string(weight) +
                                        " is outside [0, 1]");
        used.push_back(weight > 0);
    }
    LeastSquares problem(graph, used, check_cancelled);
    problem.solve({loop_weights, std::vector<double>(graph.priors.size(), 1)},
                  limits.max_iterations);
    return problem.result();
}

OptimizedPoses optimize_robustly(const PoseGraph& graph,
                                 const std::vector<bool>& candidates,
                                 const OptimizationLimits& limits,
                                 const CheckCancelled& check_cancelled)
{
    graph.check();
    check(limits);
    check_count(candidates.size(), graph);
    constexpr double kGrowth = 1.4;  // of mu, as published
    constexpr int kMaxStages = 100;
    const ErrorLimits trusted(limits.loop_confidence);
    LeastSquares problem(graph, candidates, check_cancelled);
    problem.solve(
        {{candidates.begin(), candidates.end()}, std::vector<double>(graph.priors.size(), 1)},
        limits.max_iterations);
    auto errors = problem.errors();
    const double largest = largest_excess(errors, candidates, trusted);
    if (largest <= 1) return problem.result();
    double mu = 1 / (2 * largest - 1);
    for (int stage = 0; stage < kMaxStages; ++stage, mu *= kGrowth)
    {
        const auto weights = weights_at(mu, errors, candidates, trusted);
        problem.solve(weights, limits.max_iterations);
        errors = problem.errors();
        if (stage > 0 && mu > 1 && are_binary(weights.loops) && are_binary(weights.priors)) break;
    }
    return problem.result();
}

}  // namespace fild
