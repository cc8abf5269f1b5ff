// SPDX-License-Identifier: BSD-3-Clause
#include "motion_estimate.h"

#include "fild/graph/frame_poses.h"
#include "fild/graph/graph_builder.h"
#include "fild/graph/keyframes.h"
#include "gps_priors.h"
#include "gps_votes.h"
#include "motion_fusion.h"
#include "noise_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace fild
{
namespace
{
constexpr double kLargestGpsScale = 4;

/** Motion between frames, and where it comes from. */
struct Joined
{
    Trajectory motion;
    std::vector<MotionSourceUse> sources;
};

MotionSourceUse use_of(const std::string& kind, const Trajectory& trajectory)
{
    MotionSourceUse use{kind, trajectory.report().source};
    if (trajectory.poses().empty())
        use.left_out = "gives no frame a pose";
    else
        use.factors = trajectory.poses().size() - 1;
    return use;
}

/** Leaves one of two sources out whose lengths contradict each other all along. */
void leave_out_wrong_lengths(double odometry_by_images, std::vector<MotionSourceUse>& sources)
{
    constexpr double kStandsStill = 0.2;
    constexpr double kWrong = 1.5;
    auto& odometry = sources.front();
    auto& vision = sources.back();
    if (odometry_by_images < kStandsStill)
        odometry.left_out = "it says that the robot hardly moves, and the images that it does";
    else if (odometry_by_images > kWrong || odometry_by_images < 1 / kWrong)
        vision.left_out =
            "ways by their depths are other than by " + odometry.name +
            "; a wrong baseline, unit of the depth images or unit of the odometry does that";
}

Joined joined_motion(const Trajectory& odometry, const Trajectory& vision)
{
    std::vector<MotionSourceUse> sources;
    for (const auto& [kind, trajectory] : {std::pair("odometry", &odometry), {"vision", &vision}})
        if (!trajectory->report().source.empty()) sources.push_back(use_of(kind, *trajectory));
    if (odometry.poses().empty() || vision.poses().empty())
        return {odometry.poses().empty() ? vision : odometry, std::move(sources)};
    leave_out_wrong_lengths(length_ratio(odometry, vision), sources);
    if (!sources.front().left_out.empty()) return {vision, std::move(sources)};
    if (!sources.back().left_out.empty()) return {odometry, std::move(sources)};
    const auto scales = noise_scales(odometry, vision);
    const auto fused = fused_motion(
        odometry, scales.odometry * scales.odometry, vision, scales.vision * scales.vision);
    if (2 * fused.contradictions > fused.from_both)
    {
        sources.back().contradictions = fused.contradictions;
        sources.back().left_out = "it contradicts " + sources.front().name + " in " +
                                  std::to_string(fused.contradictions) + " of " +
                                  std::to_string(fused.from_both) + " motions";
        return {odometry, std::move(sources)};
    }
    for (auto& source : sources)
    {
        const bool is_odometry = source.kind == "odometry";
        source.noise_scale = is_odometry ? scales.odometry : scales.vision;
        source.factors = fused.from_both + (is_odometry ? fused.from_odometry : fused.from_images);
        source.contradictions = fused.contradictions;
    }
    return {trajectory_from_motions(fused.motions), std::move(sources)};
}

/** A pose graph of motion and priors alone, solved. */
struct Placement
{
    Trajectory way;
    std::vector<PriorResult> priors;
};

Placement solve_placement(const Trajectory& motion,
                          const std::vector<GraphPrior>& priors,
                          const TGraphOptions& options,
                          const CheckCancelled& check_cancelled)
{
    auto built = build_pose_graph(motion, {}, options);
    // Where frames stand exactly as far apart as keyframes must, a turned motion has other
    // keyframes.
    const auto frames = frames_of(built.graph);
    std::copy_if(priors.begin(),
                 priors.end(),
                 std::back_inserter(built.graph.priors),
                 [&](const GraphPrior& prior) { return frames.count(prior.frame) > 0; });
    auto solution = solve_graph(built.graph, options, check_cancelled);
    const auto solved = solved_graph(built.graph, solution);
    return {with_poses(motion, corrected_poses(motion, solved)), std::move(solution.priors)};
}

double share_with_weight(const std::vector<PriorResult>& priors)
{
    if (priors.empty()) return 0;
    const auto count = std::count_if(
        priors.begin(), priors.end(), [](const PriorResult& prior) { return prior.weight > 0.5; });
    return static_cast<double>(count) / static_cast<double>(priors.size());
}

/** False where positions turned the robot over: mirrored ones fit a robot that drives on its roof.
 *  */
bool keeps_its_wheels_down(const Trajectory& placed, const Trajectory& way)
{
    constexpr double kCosine = 0.7;
    double sum = 0;
    for (std::size_t i = 0; i < way.frames().size(); ++i)
        sum += way.frames()[i].at.map_from_robot.rotation.col(2).dot(
            placed.frames()[i].at.map_from_robot.rotation.col(2));
    return sum > kCosine * static_cast<double>(way.frames().size());
}

/** Finds out which receivers can be used, and how uncertain they are. */
class ReceiverChoice
{
 public:
    ReceiverChoice(const Trajectory& motion,
                   const TGraphOptions& options,
                   const CheckCancelled& check_cancelled)
        : motion_(motion), options_(options), check_cancelled_(check_cancelled)
    {
        options_.robust_weights =
            true;  // weights tell which receivers lie, whatever the map is for
        for (const auto frame : select_keyframes(motion, options)) keyframes_.insert(frame);
    }

    /** The receiver by itself: the smallest scale with which most of its positions fit the motion.
     *  */
    void judge(const GpsTrack& track)
    {
        constexpr double kMost = 0.7;
        constexpr double kHalf = 0.5;
        MotionSourceUse use{"gps", track.report.source};
        double share = 0;
        for (double scale = 1; scale <= kLargestGpsScale && share < kMost; scale *= 2)
        {
            const auto priors = priors_of(track, scale);
            use.factors = priors.size();
            if (priors.empty()) break;
            use.noise_scale = scale;
            const auto placed = placed_by(priors, motion_);
            const auto solved = solve_placement(placed, priors, options_, check_cancelled_);
            share =
                keeps_its_wheels_down(placed, solved.way) ? share_with_weight(solved.priors) : 0;
        }
        if (use.factors == 0)
            use.left_out = without_positions(track);
        else if (share < kHalf)
            use.left_out = "most of its positions contradict the robot's motion";
        if (use.left_out.empty()) receivers_.push_back({&track, use.noise_scale});
        uses_.push_back(std::move(use));
    }

    const std::set<FrameId>& keyframes() const { return keyframes_; }
    std::vector<UsedReceiver> receivers() const { return receivers_; }
    const std::vector<MotionSourceUse>& uses() const { return uses_; }

 private:
    std::vector<GraphPrior> priors_of(const GpsTrack& track, double scale) const
    {
        return fild::priors_of(track, motion_, keyframes_, options_.max_gap_s, scale * scale);
    }

    std::string without_positions(const GpsTrack& track) const
    {
        if (track.positions.empty()) return "has no fix";
        const auto& frames = motion_.poses();
        const double apart = track.positions.front().seconds - frames.front().timestamp;
        return "none of its fixes is at the time of a frame; its first is " +
               std::to_string(std::llround(std::abs(apart))) + " s " +
               (apart > 0 ? "after" : "before") +
               " the first frame: is its clock in another time zone?";
    }

    const Trajectory& motion_;
    TGraphOptions options_;
    const CheckCancelled& check_cancelled_;
    std::set<FrameId> keyframes_;
    std::vector<UsedReceiver> receivers_;
    std::vector<MotionSourceUse> uses_;
};

/** Tracks that may be used, in order; the others get a reason. */
std::vector<const GpsTrack*> after_votes(const GpsRecord& gps,
                                         std::vector<MotionSourceUse>& sources)
{
    std::vector<const GpsTrack*> kept;
    const auto contradicted = contradicted_tracks(gps.tracks);
    for (std::size_t i = 0; i < gps.tracks.size(); ++i)
    {
        if (!contradicted[i])
        {
            kept.push_back(&gps.tracks[i]);
            continue;
        }
        MotionSourceUse use{"gps", gps.tracks[i].report.source};
        use.left_out = "it contradicts other receivers";
        sources.push_back(std::move(use));
    }
    return kept;
}

/** A source that is left out has a part in nothing. */
std::vector<MotionSourceUse> counted(std::vector<MotionSourceUse> sources)
{
    for (auto& source : sources)
        if (!source.left_out.empty()) source.factors = 0;
    return sources;
}

/** The motion by the most certain receiver that gives frames a pose. */
MotionEstimate by_gps_alone(const std::vector<const GpsTrack*>& tracks,
                            std::vector<MotionSourceUse> sources,
                            const GpsRecord& gps,
                            const TGraphOptions& options)
{
    std::optional<Trajectory> motion;
    std::vector<UsedReceiver> receivers;
    for (const auto* track : tracks)
    {
        const auto trajectory = trajectory_of(*track, options);
        auto use = use_of("gps", trajectory);
        if (!use.left_out.empty() && track->positions.empty()) use.left_out = "has no fix";
        if (use.left_out.empty() && motion)
            use.left_out = "without odometry and depth one receiver is used";
        if (use.left_out.empty())
        {
            motion.emplace(trajectory);
            receivers.push_back({track});
        }
        sources.push_back(std::move(use));
    }
    if (!motion) return {Trajectory({}, {}), Trajectory({}, {}), counted(std::move(sources))};
    return {*motion, *motion, counted(std::move(sources)), std::move(receivers), gps.origin};
}
}  // namespace

std::vector<std::vector<GraphPrior>> MotionEstimate::priors(const std::set<FrameId>& keyframes,
                                                            double max_gap_s) const
{
    std::vector<std::vector<GraphPrior>> all;
    all.reserve(receivers.size());
    for (const auto& [track, scale] : receivers)
        all.push_back(priors_of(*track, motion, keyframes, max_gap_s, scale * scale));
    return all;
}

std::set<FrameId> frames_of(const PoseGraph& graph)
{
    std::set<FrameId> frames;
    for (const auto& node : graph.nodes) frames.insert(node.frame);
    return frames;
}

std::vector<GraphPrior> joined(const std::vector<std::vector<GraphPrior>>& priors)
{
    std::vector<GraphPrior> all;
    for (const auto& each : priors) all.insert(all.end(), each.begin(), each.end());
    return all;
}

MotionEstimate estimate_motion(const Trajectory& odometry,
                               const Trajectory& vision,
                               const GpsRecord& gps,
                               const TGraphOptions& options,
                               const CheckCancelled& check_cancelled)
{
    auto [motion, sources] = joined_motion(odometry, vision);
    const auto tracks = after_votes(gps, sources);
    if (motion.poses().empty()) return by_gps_alone(tracks, std::move(sources), gps, options);
    ReceiverChoice choice(motion, options, check_cancelled);
    for (const auto* track : tracks) choice.judge(*track);
    const auto receivers = choice.receivers();
    sources.insert(sources.end(), choice.uses().begin(), choice.uses().end());
    if (receivers.empty()) return {motion, motion, counted(std::move(sources))};
    const MotionEstimate unplaced{motion, motion, {}, receivers};
    const auto priors = joined(unplaced.priors(choice.keyframes(), options.max_gap_s));
    const auto placed = placed_by(priors, motion);
    return {placed,
            solve_placement(placed, priors, options, check_cancelled).way,
            counted(std::move(sources)),
            receivers,
            gps.origin};
}

}  // namespace fild
