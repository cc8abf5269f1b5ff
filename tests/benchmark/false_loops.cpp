// SPDX-License-Identifier: BSD-3-Clause
// How much false loops bend the map of a run of rawlog-loop-closure: its loops and the rawlog's
// odometry are solved again, with and without random false loops among them.
//   false_loops RAWLOG RUN_FOLDER TRUTH.tum SHARE_OF_FALSE_LOOPS
#include "fild/core/angle.h"
#include "fild/core/random.h"
#include "fild/graph/frame_poses.h"
#include "fild/graph/graph_builder.h"
#include "fild/graph/loop_selection.h"
#include "fild/mapping/trajectory_builder.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using fild::FrameId;
using fild::LoopMeasurement;

std::vector<std::vector<double>> rows_of(const std::string& path, std::size_t skipped_lines)
{
    std::vector<std::vector<double>> rows;
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::string line;
    for (std::size_t i = 0; std::getline(file, line); ++i)
    {
        if (i < skipped_lines) continue;
        rows.emplace_back();
        for (auto& c : line) c = c == ',' ? ' ' : c;
        std::istringstream words(line);
        for (std::string word; words >> word;)
            rows.back().push_back(std::strtod(word.c_str(), nullptr));
    }
    return rows;
}

/** Used loops of loops.csv: their pose, and the standard deviations without the correlations. */
std::vector<LoopMeasurement> read_loops(const std::string& path)
{
    std::vector<LoopMeasurement> loops;
    for (const auto& row : rows_of(path, 1))
    {
        // An accepted loop has no rejection, so that `x` is word 11 and `weight` word 23.
        constexpr std::size_t kX = 11;
        if (row.size() < kX + 14) continue;
        const auto angle = [&](std::size_t k) { return row[kX + k] * fild::kRadiansPerDegree; };
        LoopMeasurement loop;
        loop.query = FrameId{static_cast<std::uint64_t>(row[0])};
        loop.candidate = FrameId{static_cast<std::uint64_t>(row[4])};
        loop.motion.a_from_b = {row[kX], row[kX + 1], row[kX + 2], angle(3), angle(4), angle(5)};
        for (std::size_t i = 0; i < 6; ++i)
        {
            const double deviation = i < 3 ? row[kX + 6 + i] : angle(6 + i);
            loop.motion.covariance(static_cast<int>(i), static_cast<int>(i)) =
                deviation * deviation;
        }
        loops.push_back(loop);
    }
    return loops;
}

fild::Trajectory read_trajectory(const std::string& rawlog, const fild::TGraphOptions& options)
{
    fild::TrajectoryBuilder trajectory(options);
    fild::RawlogReader reader(rawlog);
    fild::FrameBuilder frames({}, rawlog);
    for (auto entry = reader.next_entry(); entry.observation || entry.actions;
         entry = reader.next_entry())
    {
        if (entry.actions) trajectory.feed(*entry.actions);
        if (!entry.observation) continue;
        trajectory.feed(*entry.observation);
        if (!frames.accepts(*entry.observation)) continue;
        trajectory.add_frame(frames.next_id(), mrpt::Clock::toDouble(entry.observation->timestamp));
        frames.skip(*entry.observation);
    }
    return trajectory.build();
}

/** Places far from each other that are taken for one, as sure of it as a right loop. */
std::vector<LoopMeasurement> false_loops(const std::vector<std::vector<double>>& truth,
                                         const std::vector<LoopMeasurement>& right,
                                         std::size_t count)
{
    std::mt19937_64 generator(1);
    std::vector<LoopMeasurement> loops;
    while (loops.size() < count)
    {
        const auto a = generator() % truth.size();
        const auto b = generator() % truth.size();
        const double way = std::hypot(truth[a][1] - truth[b][1], truth[a][2] - truth[b][2]);
        if (a >= b || way < 5) continue;
        auto loop = right[generator() % right.size()];
        loop.candidate = FrameId{a};
        loop.query = FrameId{b};
        loops.push_back(loop);
    }
    return loops;
}

struct Outcome
{
    std::vector<fild::TrajectoryPose> poses;
    std::vector<fild::LoopResult> loops;
};

Outcome solve(const fild::Trajectory& trajectory,
              const std::vector<LoopMeasurement>& loops,
              const fild::TGraphOptions& options)
{
    const auto built = build_pose_graph(trajectory, loops, options);
    const auto solution = solve_graph(built.graph, options);
    return {corrected_poses(trajectory, solved_graph(built.graph, solution)), solution.loops};
}

/** Root mean square distance between two solutions: both begin at the same pose. */
double difference(const Outcome& a, const Outcome& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.poses.size(); ++i)
        sum += std::pow(a.poses[i].map_from_robot.distanceTo(b.poses[i].map_from_robot), 2);
    return std::sqrt(sum / static_cast<double>(a.poses.size()));
}

void run(const std::vector<std::string>& arguments)
{
    if (arguments.size() != 4)
        throw std::runtime_error("usage: false_loops RAWLOG RUN_FOLDER TRUTH.tum SHARE");
    const double share = std::stod(arguments[3]);
    const fild::TGraphOptions options;
    const auto trajectory = read_trajectory(arguments[0], options);
    const auto right = read_loops(arguments[1] + "/loops.csv");
    if (right.empty()) throw std::runtime_error("no loop with a pose in " + arguments[1]);
    const auto count = static_cast<std::size_t>(
        std::lround(share / (1 - share) * static_cast<double>(right.size())));
    auto all = right;
    const auto wrong = false_loops(rows_of(arguments[2], 0), right, count);
    all.insert(all.end(), wrong.begin(), wrong.end());
    const auto clean = solve(trajectory, right, options);
    const auto mixed = solve(trajectory, all, options);
    std::size_t with_weight = 0;
    std::size_t right_without = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const bool is_used = mixed.loops[i].weight > 0;
        if (i >= right.size() && is_used) ++with_weight;
        if (i < right.size() && !is_used) ++right_without;
    }
    std::cout << right.size() << " right and " << count << " false loops: " << with_weight
              << " false ones have a weight, " << right_without
              << " right ones have none; poses moved by " << difference(clean, mixed)
              << " m (RMS)\n";
}
}  // namespace

int main(int argc, char** argv)
{
    try
    {
        run({argv + 1, argv + argc});
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << "false_loops: " << error.what() << "\n";
        return 1;
    }
}
