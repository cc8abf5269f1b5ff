// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/trajectory_builder.h"

#include "dead_reckoning.h"
#include "sensor_name.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
/** The one source of several that is used. */
struct SourceChoice
{
    std::string wanted_label;  ///< empty: any
    std::string name;  ///< empty: none yet
    std::set<std::string> others;

    /** True for readings of the source that is used; the first one becomes it. */
    bool is_used(const std::string& candidate, const std::string& label)
    {
        const bool is_wanted = wanted_label.empty() || wanted_label == label;
        if (is_wanted && name.empty()) name = candidate;
        if (is_wanted && name == candidate) return true;
        others.insert(candidate);
        return false;
    }
};

double seconds_of(const mrpt::obs::CObservation& observation)
{
    return mrpt::Clock::toDouble(observation.timestamp);
}
}  // namespace

struct TrajectoryBuilder::State
{
    explicit State(const TGraphOptions& options)
        : source{options.motion_sensor_label, {}, {}},
          max_gap_s(options.max_gap_s),
          reckoning(options)
    {
    }

    SourceChoice source;
    double max_gap_s;
    DeadReckoning reckoning;
    std::optional<double> last_observation_seconds;  ///< of any sensor
    bool is_movement_pending = false;  ///< the actions wait for an observation after them
    std::vector<AwaitedFrame> frames;
    std::vector<std::optional<FoundPose>>
        found;  ///< of each frame, among readings that are forgotten
    std::optional<TimedReading> first_reading;  ///< when it is forgotten

    void forget_readings();
};

/** Frames that come later need the readings since the last frame, and a late camera some before it.
 *  Frames that are there keep what they found at the others. */
void TrajectoryBuilder::State::forget_readings()
{
    constexpr std::size_t kLateReadings = 10000;
    const auto kept = reckoning.kept();
    const auto needed = kept.forgotten + 2 * kLateReadings;
    if (frames.empty() || frames.back().arrival < needed) return;
    if (!first_reading) first_reading = kept.readings.front();
    const auto first_kept = frames.back().arrival - kLateReadings;
    found.resize(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
        found[i] = pose_at(kept, frames[i], max_gap_s, std::move(found[i]), first_kept);
    reckoning.forget(first_kept - kept.forgotten);
}

TrajectoryBuilder::TrajectoryBuilder(const TGraphOptions& options)
{
    options.check();
    state_ = std::make_unique<State>(options);
}

TrajectoryBuilder::~TrajectoryBuilder() = default;

void TrajectoryBuilder::feed(const mrpt::obs::CObservation& observation)
{
    auto& state = *state_;
    const bool has_time = observation.timestamp != INVALID_TIMESTAMP;
    // Where the actions led is where the first observation after them was made.
    if (has_time && state.is_movement_pending)
        state.is_movement_pending = !state.reckoning.place(seconds_of(observation));
    if (has_time) state.last_observation_seconds = seconds_of(observation);
    const auto reading = pose_reading_of(observation);
    if (!reading || !state.source.is_used(name_of(observation), label_of(observation))) return;
    if (has_time)
        state.reckoning.add_pose(seconds_of(observation), *reading);
    else
        state.reckoning.count_unusable();
    state.forget_readings();
}

void TrajectoryBuilder::feed(const mrpt::obs::CActionCollection& actions)
{
    auto& state = *state_;
    const auto reading = movement_reading_of(actions);
    if (!reading || !state.source.is_used("actions", "")) return;
    if (state.reckoning.readings().empty() && state.last_observation_seconds)
        state.reckoning.place(*state.last_observation_seconds);
    if (state.reckoning.add_movement(*reading)) state.is_movement_pending = true;
    state.forget_readings();
}

void TrajectoryBuilder::add_frame(FrameId frame, double timestamp)
{
    auto& frames = state_->frames;
    if (!frames.empty() && frame <= frames.back().id)
        throw std::invalid_argument("TrajectoryBuilder::add_frame: frame " +
                                    std::to_string(to_index(frame)) + " comes after frame " +
                                    std::to_string(to_index(frames.back().id)));
    frames.push_back({frame, timestamp, readings()});
}

std::size_t TrajectoryBuilder::readings() const
{
    return state_->reckoning.clock().accepted();
}

std::size_t TrajectoryBuilder::readings_kept() const
{
    return state_->reckoning.readings().size();
}

std::optional<RelativeMotion> TrajectoryBuilder::motion_so_far() const
{
    const auto& readings = state_->reckoning.readings();
    if (readings.size() < 2) return std::nullopt;
    const auto frame = [](FrameId id, const TimedReading& reading) {
        return Trajectory::Frame{id, reading.seconds, reading.at};
    };
    const auto& begin = state_->first_reading ? *state_->first_reading : readings.front();
    const FrameId first{0};
    const FrameId last{1};
    return Trajectory({frame(first, begin), frame(last, readings.back())}, {}).motion(first, last);
}

Trajectory TrajectoryBuilder::build() const
{
    const auto& clock = state_->reckoning.clock();
    TrajectoryReport report;
    report.source = state_->source.name;
    report.other_sources.assign(state_->source.others.begin(), state_->source.others.end());
    report.readings = clock.accepted();
    report.unusable_readings = state_->reckoning.unusable();
    report.late_readings = clock.late();
    report.clock_jumps = clock.jumps();
    report.gaps = clock.gaps();
    report.resets = state_->reckoning.resets();
    std::vector<Trajectory::Frame> frames;
    auto forgotten = state_->found;
    forgotten.resize(state_->frames.size());
    for (std::size_t i = 0; i < forgotten.size(); ++i)
    {
        const auto& frame = state_->frames[i];
        const auto found =
            pose_at(state_->reckoning.kept(), frame, state_->max_gap_s, std::move(forgotten[i]));
        if (found)
            frames.push_back({frame.id, frame.timestamp, found->at});
        else
            report.frames_without_pose.push_back(frame.id);
    }
    return {std::move(frames), std::move(report)};
}

}  // namespace fild
