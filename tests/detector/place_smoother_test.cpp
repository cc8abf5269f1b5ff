// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_smoother.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace
{
using fild::ComparedPlace;
using fild::Entrance;
using fild::FrameId;
using fild::PlaceBelief;
using fild::PlaceEvidence;
using fild::PlaceSmoother;
using fild::PlaceStates;
using fild::TConsistencyOptions;

TConsistencyOptions belief_options()
{
    TConsistencyOptions options;
    options.belief = true;
    return options;
}

/** All states in one row: new ground, the places, their look-alikes. */
std::vector<double> in_a_row(const PlaceStates& states)
{
    std::vector<double> row{states.new_ground};
    row.insert(row.end(), states.same.begin(), states.same.end());
    row.insert(row.end(), states.look_alike.begin(), states.look_alike.end());
    return row;
}

/** What PlaceBelief says of motion, state by state. The map has `places` places. */
class Motion
{
 public:
    Motion(const TConsistencyOptions& options, std::size_t places) : options_(options), n_(places)
    {
    }

    /** Probability of each state after the move from one of them.
     *  \param is_later  the move comes after the frame that is asked for. */
    std::vector<double> after(std::size_t state, const PlaceEvidence& evidence, bool is_later) const
    {
        const auto& entrances = evidence.entrances;
        const int step = evidence.has_moved ? options_.place_step : 0;
        const double leaves = evidence.has_moved ? options_.leave_probability : 0;
        std::vector<double> to(1 + 2 * n_, 0);
        const double jump = entrances.empty() ? 0 : options_.jump_probability;
        const double stay = 1 - leaves - jump;
        if (state == 0)
        {
            const double returns = entrances.empty() ? 0 : options_.return_probability;
            to[0] = 1 - returns;
            for (const auto& [place, was_near] : entrances)
            {
                const double to_this = returns / count(entrances);
                to[1 + place] += was_near * to_this;
                enter(to, place, (1 - was_near) * to_this);
            }
            return to;
        }
        const bool is_look_alike = state > n_;
        const std::size_t first = is_look_alike ? 1 + n_ : 1;
        for (std::size_t place = 0; place < n_; ++place)
        {
            if (distance(place, state - first) > step) continue;
            const double share = 1.0 / (2 * step + 1);
            to[first + place] += share * stay;
            to[0] += share * leaves;
            for (const auto& [end, was_near] : entrances)
            {
                const double jumps = share * jump / count(entrances);
                const bool is_near = distance(place, end) <= options_.near_places;
                if (is_look_alike ? !is_later : is_near)
                    to[first + end] += jumps;
                else
                    enter(to, end, jumps);
            }
        }
        return to;
    }

 private:
    static double count(const std::vector<Entrance>& entrances)
    {
        return static_cast<double>(entrances.size());
    }

    static int distance(std::size_t a, std::size_t b)
    {
        return std::abs(static_cast<int>(a) - static_cast<int>(b));
    }

    /** From new ground, or from far away. */
    void enter(std::vector<double>& to, std::size_t place, double probability) const
    {
        to[1 + place] += (1 - options_.look_alike_share) * probability;
        to[1 + n_ + place] += options_.look_alike_share * probability;
    }

    TConsistencyOptions options_;
    std::size_t n_;
};

/** Sums over all paths of states, one for each frame, from new ground. */
class AllPaths
{
 public:
    AllPaths(const TConsistencyOptions& options, std::vector<PlaceEvidence> frames)
        : options_(options), frames_(std::move(frames))
    {
    }

    /** The probability of each state at a frame, given all frames. */
    std::vector<double> at(std::size_t frame)
    {
        sums_.assign(1 + 2 * places(frame), 0);
        asked_ = frame;
        walk(0, 0, 0, 1);
        double total = 0;
        for (const double sum : sums_) total += sum;
        for (auto& sum : sums_) sum /= total;
        return sums_;
    }

 private:
    std::size_t places(std::size_t frame) const { return frames_[frame].likelihood.same.size(); }

    /** Of a state before the frame, when the map had fewer places. */
    std::size_t number_in_larger_map(std::size_t state, std::size_t before, std::size_t now) const
    {
        return state > before ? state - before + now : state;
    }

    void walk(std::size_t frame, std::size_t state, std::size_t asked_state, double weight)
    {
        if (frame == frames_.size())
        {
            sums_[asked_state] += weight;
            return;
        }
        const auto& evidence = frames_[frame];
        const auto from =
            frame == 0 ? 0 : number_in_larger_map(state, places(frame - 1), places(frame));
        const auto to = Motion(options_, places(frame)).after(from, evidence, frame > asked_);
        const auto likelihood = in_a_row(evidence.likelihood);
        for (std::size_t next = 0; next < to.size(); ++next)
            if (to[next] > 0)
                walk(frame + 1,
                     next,
                     frame == asked_ ? next : asked_state,
                     weight * to[next] * likelihood[next]);
    }

    TConsistencyOptions options_;
    std::vector<PlaceEvidence> frames_;
    std::size_t asked_ = 0;
    std::vector<double> sums_;
};

void expect_equal(const PlaceStates& states, const std::vector<double>& expected)
{
    const auto row = in_a_row(states);
    ASSERT_EQ(row.size(), expected.size());
    for (std::size_t i = 0; i < row.size(); ++i) EXPECT_NEAR(row[i], expected[i], 1e-12) << i;
}

TEST(PlaceSmoother, IsTheSumOverAllPathsWhileTheMapGrows)
{
    auto small = belief_options();
    small.place_step = 1;
    small.near_places = 1;
    PlaceBelief belief(small);
    PlaceSmoother smoother(small);
    std::vector<PlaceEvidence> frames;
    const std::vector<std::vector<ComparedPlace>> compared{
        {{FrameId{1}, {{2, 1}}}},
        {},
        {{FrameId{0}, {{1, -1}}}, {FrameId{3}, std::nullopt}},
        {{FrameId{4}, {{3, 2}}}, {FrameId{1}, {{0.5, 0}}}}};
    for (std::size_t i = 0; i < 2; ++i) belief.add_place(FrameId{i});
    for (std::size_t i = 0; i < compared.size(); ++i)
    {
        if (i > 0) belief.add_place(FrameId{i + 1});
        belief.update(compared[i], i != 2);  // another camera at the instant of the frame before
        smoother.add(belief);
        frames.push_back(belief.evidence());
    }
    AllPaths paths(small, frames);
    for (std::size_t i = 0; i < compared.size(); ++i)
    {
        SCOPED_TRACE(i);
        expect_equal(smoother.oldest(), paths.at(i));
        smoother.drop_oldest();
    }
    EXPECT_EQ(smoother.size(), 0U);
}

TEST(PlaceSmoother, OfOneFrameSaysWhatTheBeliefSays)
{
    PlaceBelief belief(belief_options());
    PlaceSmoother smoother(belief_options());
    for (std::size_t i = 0; i < 50; ++i) belief.add_place(FrameId{i});
    belief.update({{FrameId{7}, {{4, 3}}}});
    smoother.add(belief);
    EXPECT_EQ(in_a_row(smoother.oldest()), in_a_row(belief.states()));
}

/** Probability that a frame shows a place of the map, from the frames in turn: by the belief, and
 *  with those after it. Each is compared with one place and two others in vain. */
struct Judged
{
    double on_line = 0;
    double with_later_frames = 0;
};

Judged first_of(const std::vector<ComparedPlace>& places,
                const TConsistencyOptions& options = belief_options())
{
    PlaceBelief belief(options);
    PlaceSmoother smoother(options);
    for (std::size_t i = 0; i < 100; ++i) belief.add_place(FrameId{i});
    Judged judged;
    for (const auto& place : places)
    {
        const double now =
            belief.update({place, {FrameId{90}, std::nullopt}, {FrameId{91}, std::nullopt}});
        if (smoother.size() == 0) judged.on_line = now;
        smoother.add(belief);
    }
    judged.with_later_frames = fild::sum_of(smoother.oldest().same);
    return judged;
}

TEST(PlaceSmoother, LetsAClearReturnVouchForTheDoubtfulFrameBeforeIt)
{
    const auto judged = first_of({{FrameId{10}, {{2, 2}}},
                                  {FrameId{11}, {{8, 5}}},
                                  {FrameId{12}, {{8, 5}}},
                                  {FrameId{13}, {{8, 5}}}});
    EXPECT_LT(judged.on_line, 0.4);
    EXPECT_GT(judged.with_later_frames, 0.7);
}

TEST(PlaceSmoother, LetsFramesWithoutAnyPlaceSpeakAgainstTheConvincingOneBeforeThem)
{
    const ComparedPlace nothing{FrameId{50}, std::nullopt};
    const auto judged =
        first_of({{FrameId{10}, {{11, 10}}}, nothing, nothing, nothing, nothing, nothing});
    EXPECT_GT(judged.on_line, 0.99);
    EXPECT_LT(judged.with_later_frames, 0.99);
}

// As in a corridor that looks alike all along: then comes a clear return, but to another part of
// it.
TEST(PlaceSmoother, DoesNotLetAReturnElsewhereVouchForLookAlikes)
{
    std::vector<ComparedPlace> places;
    for (std::uint64_t i = 0; i < 6; ++i) places.push_back({FrameId{60 + i}, {{6, -0.5}}});
    auto options = belief_options();
    options.jump_probability = 0.15;
    options.leave_probability = 0.0003;
    const auto alone = first_of(places, options);
    for (std::uint64_t i = 0; i < 6; ++i) places.push_back({FrameId{10 + i}, {{12, 8}}});
    const auto with_return = first_of(places, options);
    EXPECT_LT(alone.with_later_frames, 0.5);
    EXPECT_LT(with_return.with_later_frames, 0.5);
}

/** A row of look-alikes stays one, however long. */
TEST(PlaceSmoother, DoesNotTakeARowOfLookAlikesForAReturn)
{
    std::vector<ComparedPlace> row;
    for (std::uint64_t i = 0; i < 20; ++i) row.push_back({FrameId{10 + i}, {{10, -2}}});
    const auto judged = first_of(row);
    EXPECT_LT(judged.on_line, 0.5);
    EXPECT_LT(judged.with_later_frames, judged.on_line);
}

TEST(PlaceSmoother, RemainsAProbabilityOverALongWindow)
{
    PlaceBelief belief(belief_options());
    PlaceSmoother smoother(belief_options());
    for (std::size_t i = 0; i < 30; ++i) belief.add_place(FrameId{i});
    for (std::uint64_t i = 0; i < 2000; ++i)
    {
        belief.update({{FrameId{i % 30}, {{i % 7 == 0 ? 12.0 : -12.0, 6}}}});
        smoother.add(belief);
    }
    const auto states = smoother.oldest();
    EXPECT_NEAR(states.sum(), 1, 1e-9);
    for (const double each : in_a_row(states)) EXPECT_GE(each, 0);
}

}  // namespace
