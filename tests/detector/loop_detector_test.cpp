// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/loop_detector.h"

#include "fild/core/random.h"
#include "fild/detector/loop_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace
{
using fild::FrameDescription;
using fild::FrameId;
using fild::Rejection;

constexpr std::size_t kDimension = 16;
constexpr std::size_t kPoints = 80;

double uniform(std::mt19937_64& generator, double low, double high)
{
    return low + (high - low) * static_cast<double>(generator() >> 11U) * 0x1.0p-53;
}

/** What a camera sees at place number `place`, moved sideways by `shift` metres: the same world
 * points with the same codes for every visit, a descriptor of its own for every place. */
FrameDescription view_of(std::uint64_t place, double shift)
{
    std::mt19937_64 generator(place);
    FrameDescription view;
    view.sensor_label = "CAMERA1";
    double squares = 0;
    for (std::size_t k = 0; k < kDimension; ++k)
    {
        view.global.push_back(static_cast<float>(fild::standard_normal(generator)));
        squares += static_cast<double>(view.global.back()) * view.global.back();
    }
    for (auto& x : view.global) x /= static_cast<float>(std::sqrt(squares));
    auto& codes = view.local.codes;
    codes.bits = 256;
    codes.words_per_code = 4;
    view.metric.camera = fild::CameraModel{500, 500, 320, 240, 640, 480, fild::LensModel::none, {}};
    view.metric.depths.source = fild::DepthSource::depth_image;
    for (std::size_t i = 0; i < kPoints; ++i)
    {
        const double x = uniform(generator, -3, 3) + shift;
        const double y = uniform(generator, -2, 2);
        const double z = uniform(generator, 4, 12);
        view.local.positions.push_back(
            {static_cast<float>(500 * x / z + 320), static_cast<float>(500 * y / z + 240)});
        view.metric.depths.metres.push_back(static_cast<float>(z));
        view.metric.depths.deviations_m.push_back(static_cast<float>(0.005 * z));
        for (int w = 0; w < 4; ++w) codes.words.push_back(generator());
    }
    view.local.shapes.resize(kPoints, {64, 0});
    view.local.image_size = {640, 480};
    return view;
}

fild::TDetectorOptions options_with_delay(double seconds)
{
    fild::TDetectorOptions options;
    options.index.delay_seconds = seconds;
    options.consistency.consecutive_frames = 1;
    return options;
}

/** Weighs evidence, so that the views of one place convince, and carries a belief. */
fild::TDetectorOptions options_with_belief(double delay_seconds)
{
    auto options = options_with_delay(delay_seconds);
    options.verification.one_shape = true;
    options.same_place.enabled = true;
    options.same_place.chance.inliers = 2;
    options.same_place.look_alike.bias = 5;
    options.consistency.belief = true;
    return options;
}

/** Drives along the places at one frame a second.
 *  \param change  of the view of a frame. */
std::vector<fild::DetectorOutcome> drive(
    const fild::TDetectorOptions& options,
    const std::vector<std::uint64_t>& places,
    const std::function<void(std::size_t, FrameDescription&)>& change = [](auto, auto&) {})
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    std::vector<fild::DetectorOutcome> outcomes;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        auto view = view_of(places[i], 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = 1000 + static_cast<double>(i);
        change(i, view);
        for (auto& outcome : detector.process(std::move(view), times))
            outcomes.push_back(std::move(outcome));
    }
    for (auto& outcome : detector.finish(times)) outcomes.push_back(std::move(outcome));
    const fild::LoopPoses poses(options);
    for (auto& outcome : outcomes) poses.add_pose(outcome, map, times);
    return outcomes;
}

std::vector<Rejection> rejections(const std::vector<fild::DetectorOutcome>& outcomes)
{
    std::vector<Rejection> result;
    result.reserve(outcomes.size());
    for (const auto& outcome : outcomes) result.push_back(outcome.verdict.rejection);
    return result;
}

TEST(LoopDetector, FindsAReturnAndSaysWhyTheOthersAreNone)
{
    const auto outcomes = drive(options_with_delay(2), {10, 11, 12, 10, 11});
    EXPECT_EQ(rejections(outcomes),
              (std::vector<Rejection>{Rejection::too_early,
                                      Rejection::too_early,
                                      Rejection::too_few_matches,
                                      Rejection::none,
                                      Rejection::none}));
    const auto& loop = outcomes[3];
    EXPECT_EQ(loop.verdict.candidate->frame, FrameId{0});
    EXPECT_NEAR(loop.verdict.candidate->similarity, 1, 1e-5);
    EXPECT_EQ(loop.verdict.keypoints, kPoints);
    EXPECT_EQ(loop.verdict.matches, kPoints);
    EXPECT_EQ(loop.matches.size(), kPoints);
    EXPECT_EQ(loop.verdict.inliers, loop.inliers.size());
    EXPECT_GE(loop.inliers.size(), kPoints - 2);
    EXPECT_EQ(outcomes[4].verdict.candidate->frame, FrameId{1});
}

TEST(LoopDetector, GivesAnAcceptedLoopItsMetricPose)
{
    const auto outcomes = drive(options_with_delay(2), {10, 11, 12, 10, 11});
    for (const auto& outcome : outcomes)
    {
        EXPECT_EQ(outcome.pose.has_value(), outcome.verdict.accepted());
        EXPECT_EQ(outcome.depth_source, fild::DepthSource::depth_image);
    }
    const auto& loop = outcomes[3];
    ASSERT_TRUE(loop.pose->candidate_from_query.has_value());
    // The scene moved to the right by 0.9 m: so did the camera to the left.
    const auto& translation = loop.pose->candidate_from_query->b_from_a.translation;
    EXPECT_NEAR(translation[0], -0.9, 0.01);
    EXPECT_NEAR(translation[1], 0, 0.01);
    EXPECT_NEAR(translation[2], 0, 0.02);
    EXPECT_EQ(loop.keypoint_matches.size(), loop.matches.size());
}

TEST(LoopDetector, GivesTheSameVerdictsWithAndWithoutPoses)
{
    auto options = options_with_delay(2);
    const auto with = drive(options, {10, 11, 12, 10, 11});
    options.relative_pose.enabled = false;
    const auto without = drive(options, {10, 11, 12, 10, 11});
    EXPECT_EQ(rejections(with), rejections(without));
    for (std::size_t i = 0; i < with.size(); ++i)
    {
        EXPECT_FALSE(without[i].pose.has_value());
        EXPECT_EQ(with[i].verdict.inliers, without[i].verdict.inliers);
    }
}

TEST(LoopDetector, SaysWhyALoopHasNoPose)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(2), kDimension, map);
    fild::StageTimes times;
    fild::DetectorOutcome last;
    for (std::size_t i = 0; i < 4; ++i)
    {
        auto view = view_of(i == 3 ? 10 : 10 + i, 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        if (i == 3) view.metric.camera.reset();
        last = detector.process(std::move(view), times).front();
    }
    ASSERT_TRUE(last.verdict.accepted());
    fild::LoopPoses(options_with_delay(2)).add_pose(last, map, times);
    ASSERT_TRUE(last.pose.has_value());
    EXPECT_EQ(last.pose->reason, fild::NoMetricPose::not_calibrated);
    EXPECT_FALSE(map.find(FrameId{3})->metric.camera.has_value());
    EXPECT_EQ(map.find(FrameId{4}), nullptr);
}

TEST(LoopDetector, NeverAnswersWithinTheDelay)
{
    for (const auto& outcome : drive(options_with_delay(100), {10, 10, 10, 10}))
        EXPECT_EQ(outcome.verdict.rejection, Rejection::too_early);
}

TEST(LoopDetector, WaitsForBetaFramesInARow)
{
    auto options = options_with_delay(2);
    options.consistency.consecutive_frames = 2;
    const auto outcomes = drive(options, {10, 11, 12, 10, 11});
    EXPECT_EQ(outcomes[3].verdict.rejection, Rejection::not_consistent_yet);
    EXPECT_TRUE(outcomes[4].verdict.accepted());
}

TEST(LoopDetector, KeepsARowAcrossAFrameThatCannotBeUsed)
{
    auto options = options_with_delay(2);
    options.consistency.consecutive_frames = 2;
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    fild::DetectorOutcome last;
    const std::vector<std::uint64_t> places = {10, 11, 12, 10, 0, 11};
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        auto view = view_of(places[i], 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        if (i == 4) view.defect = Rejection::missing_image;
        last = detector.process(std::move(view), times).front();
    }
    EXPECT_TRUE(last.verdict.accepted());
}

TEST(LoopDetector, DoesNotVerifyBelowTheSimilarityAskedFor)
{
    auto options = options_with_delay(2);
    options.index.min_similarity = 0.99;
    const auto outcomes = drive(options, {10, 11, 12, 10});
    EXPECT_EQ(outcomes[2].verdict.rejection, Rejection::below_similarity);
    EXPECT_TRUE(outcomes[2].verdict.candidate.has_value());
    EXPECT_TRUE(outcomes[3].verdict.accepted());
}

/** Place 10 looks (by its global descriptor) like the far away place 99. */
TEST(LoopDetector, TakesTheCandidateWithTheMostInliersOfSeveral)
{
    const auto run = [](int candidates)
    {
        auto options = options_with_delay(1);
        options.index.candidates = candidates;
        fild::PlaceMap map;
        fild::LoopDetector detector(options, kDimension, map);
        fild::StageTimes times;
        auto impostor = view_of(99, 0);
        impostor.global = view_of(10, 0).global;
        auto same_place = view_of(10, 0);
        same_place.frame = FrameId{1};
        same_place.timestamp = 5;
        for (auto& x : same_place.global) x *= 0.9F;  // not quite as similar as the impostor
        auto query = view_of(10, 0.4);
        query.frame = FrameId{2};
        query.timestamp = 10;
        detector.process(std::move(impostor), times);
        detector.process(std::move(same_place), times);
        return detector.process(std::move(query), times).front().verdict;
    };
    EXPECT_EQ(run(1).rejection, Rejection::too_few_matches);
    EXPECT_TRUE(run(2).accepted());
    EXPECT_EQ(run(2).candidate->frame, FrameId{1});
}

/** The place where only the first `points` points are seen as at place 10. */
FrameDescription part_of_place_10(std::size_t points, std::size_t frame, double timestamp)
{
    auto view = view_of(10, 0);
    const auto other = view_of(50 + frame, 0);
    auto& words = view.local.codes.words;
    for (std::size_t i = 4 * points; i < words.size(); ++i) words[i] = other.local.codes.words[i];
    if (frame > 0) view.global = other.global;
    view.frame = FrameId{frame};
    view.timestamp = timestamp;
    return view;
}

/** The descriptor leads to frame 0; each frame after it shows more of the query's place. Frame 4
 *  shows all, but is still in the delay queue. */
TEST(LoopDetector, FollowsNeighboursAsLongAsTheInliersGrow)
{
    const auto run = [](int reach)
    {
        auto options = options_with_delay(2);
        options.candidates.neighbour_reach = reach;
        fild::PlaceMap map;
        fild::LoopDetector detector(options, kDimension, map);
        fild::StageTimes times;
        const std::vector<std::size_t> points{30, 40, 50, 60};
        for (std::size_t i = 0; i < points.size(); ++i)
            detector.process(part_of_place_10(points[i], i, static_cast<double>(i)), times);
        detector.process(part_of_place_10(kPoints, 4, 9), times);
        auto query = view_of(10, 0.4);
        query.frame = FrameId{5};
        query.timestamp = 10;
        return detector.process(std::move(query), times).front().verdict;
    };
    EXPECT_EQ(run(0).candidate->frame, FrameId{0});
    const auto followed = run(1);
    EXPECT_TRUE(followed.accepted());
    EXPECT_EQ(followed.candidate->frame, FrameId{3});
    EXPECT_GT(followed.inliers, run(0).inliers);
    EXPECT_LT(followed.candidate->similarity, run(0).candidate->similarity);
}

/** Frame 2 shows less of the query's place than frame 1 and frame 3 more than both: who looks two
 * frames ahead gets there. */
TEST(LoopDetector, LooksBeyondAWorseNeighbourAsFarAsAsked)
{
    const auto found_with = [](int reach)
    {
        auto options = options_with_delay(2);
        options.candidates.neighbour_reach = reach;
        fild::PlaceMap map;
        fild::LoopDetector detector(options, kDimension, map);
        fild::StageTimes times;
        const std::vector<std::size_t> points{40, 50, 30, 60};
        for (std::size_t i = 0; i < points.size(); ++i)
            detector.process(part_of_place_10(points[i], i, static_cast<double>(i)), times);
        auto query = view_of(10, 0.4);
        query.frame = FrameId{4};
        query.timestamp = 10;
        return detector.process(std::move(query), times).front().verdict.candidate->frame;
    };
    EXPECT_EQ(found_with(1), FrameId{1});
    EXPECT_EQ(found_with(2), FrameId{3});
}

/** The second query's descriptor leads nowhere; the place of the first does. */
TEST(LoopDetector, FollowsTheBeliefFromFrameToFrame)
{
    const auto second_query = [](bool follow_belief)
    {
        auto options = options_with_belief(5);
        options.index.candidates = 1;
        options.candidates.follow_belief = follow_belief;
        fild::PlaceMap map;
        fild::LoopDetector detector(options, kDimension, map);
        fild::StageTimes times;
        const std::vector<std::uint64_t> places{10, 20, 30, 10, 10};
        const std::vector<double> timestamps{0, 1, 2, 10, 11};
        fild::DetectorOutcome last;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            auto view = view_of(places[i], 0.1 * static_cast<double>(i));
            if (i == 4) view.global = view_of(30, 0).global;
            view.frame = FrameId{i};
            view.timestamp = timestamps[i];
            last = detector.process(std::move(view), times).front();
        }
        return last.verdict;
    };
    EXPECT_FALSE(second_query(false).accepted());
    const auto followed = second_query(true);
    EXPECT_TRUE(followed.accepted());
    EXPECT_EQ(followed.candidate->frame, FrameId{0});
}

TEST(LoopDetector, SaysWhichExplanationTheEvidenceLeavesOpen)
{
    auto options = options_with_belief(2);
    const auto last = [&] { return drive(options, {10, 11, 12, 10}).back(); };
    const auto good = last();
    EXPECT_TRUE(good.verdict.accepted());
    EXPECT_GT(good.verdict.support, options.same_place.min_probability);
    ASSERT_TRUE(good.considered.front().odds);
    EXPECT_GT(good.considered.front().evidence[to_index(fild::Evidence::inlier_share)], 0.9);
    options.same_place.look_alike.bias = -5;
    EXPECT_EQ(last().verdict.rejection, Rejection::may_be_look_alike);
    options.same_place.look_alike.bias = 5;
    options.same_place.chance.bias = -30;
    EXPECT_EQ(last().verdict.rejection, Rejection::may_be_chance);
    EXPECT_LT(last().verdict.support, 0.1);
}

/** Weak pairs: a first return to a place is not believed before others follow. */
fild::TDetectorOptions options_for_weak_pairs(double look_ahead_seconds)
{
    auto options = options_with_belief(5);
    options.same_place.look_alike.bias = 2.5;  // a pair reaches 0.92, and 0.95 is asked for
    options.consistency.look_ahead_seconds = look_ahead_seconds;
    return options;
}

/** Inside a certain return the belief accepts what a pair alone does not, down to a limit. */
TEST(LoopDetector, BelievesAWeakPairOnlyDownToMinPairProbability)
{
    auto options = options_for_weak_pairs(0);
    const std::vector<std::uint64_t> places{10, 11, 12, 13, 14, 15, 16, 10, 11, 12, 13, 14};
    EXPECT_TRUE(drive(options, places).back().verdict.accepted());
    options.consistency.min_pair_probability = 0.93;
    EXPECT_EQ(drive(options, places).back().verdict.rejection, Rejection::may_be_look_alike);
}

TEST(LoopDetector, LetsLaterFramesVouchForADoubtfulOne)
{
    const std::vector<std::uint64_t> places{10, 11, 12, 13, 14, 15, 16, 10, 11, 12, 13, 14};
    constexpr std::size_t kFirstReturn = 7;
    const auto on_line = drive(options_for_weak_pairs(0), places)[kFirstReturn];
    EXPECT_EQ(on_line.verdict.rejection, Rejection::may_be_look_alike);
    EXPECT_FALSE(on_line.pose);
    for (const double seconds : {3.0, 1000.0})
    {
        const auto looked_ahead = drive(options_for_weak_pairs(seconds), places)[kFirstReturn];
        EXPECT_TRUE(looked_ahead.verdict.accepted());
        EXPECT_GT(looked_ahead.verdict.support, on_line.verdict.support);
        EXPECT_EQ(looked_ahead.verdict.candidate->frame, FrameId{0});
        ASSERT_TRUE(looked_ahead.pose);
        EXPECT_TRUE(looked_ahead.pose->candidate_from_query);
    }
}

TEST(LoopDetector, LetsLaterFramesRefuseALonelyOne)
{
    std::vector<std::uint64_t> places{10, 11, 12, 13, 14, 15, 16, 10};
    for (std::uint64_t i = 0; i < 6; ++i) places.push_back(50 + i);
    constexpr std::size_t kReturn = 7;
    auto options = options_with_belief(5);
    EXPECT_TRUE(drive(options, places)[kReturn].verdict.accepted());
    options.consistency.look_ahead_seconds = 5;
    const auto refused = drive(options, places)[kReturn];
    EXPECT_EQ(refused.verdict.rejection, Rejection::not_consistent_yet);
    EXPECT_LT(refused.verdict.support, options.same_place.min_probability);
    EXPECT_FALSE(refused.pose);
}

/** Frames 0 and 9 show parts of place 20, and frame 9 the larger one. The camera comes to place 20,
 *  then to what frames 1 to 3 show. */
TEST(LoopDetector, NamesTheCandidateThatLaterFramesConfirm)
{
    constexpr std::size_t kReturn = 16;
    const auto returned = [](double look_ahead_seconds)
    {
        auto options = options_with_belief(5);
        options.index.candidates = 12;
        options.consistency.place_step = 1;
        options.consistency.near_places = 3;
        options.consistency.look_ahead_seconds = look_ahead_seconds;
        const auto show_parts_of_place_20 = [](std::size_t frame, FrameDescription& view)
        {
            if (frame != 0 && frame != 9) return;
            const auto other = view.local.codes.words;
            view.local = view_of(20, 0).local;
            for (std::size_t i = 4 * (frame == 0 ? 60 : 70); i < other.size(); ++i)
                view.local.codes.words[i] = other[i];
        };
        std::vector<std::uint64_t> places{100, 21, 22, 23};
        for (std::uint64_t i = 4; i < kReturn; ++i) places.push_back(100 + i);
        for (const std::uint64_t place : {20, 21, 22, 23}) places.push_back(place);
        return drive(options, places, show_parts_of_place_20)[kReturn];
    };
    EXPECT_EQ(returned(0).verdict.candidate->frame, FrameId{9});
    const auto looked_ahead = returned(3);
    EXPECT_EQ(looked_ahead.verdict.candidate->frame, FrameId{0});
    EXPECT_TRUE(looked_ahead.verdict.accepted());
    EXPECT_EQ(looked_ahead.verdict.inliers, 60U);
    EXPECT_EQ(looked_ahead.matches.size(), looked_ahead.keypoint_matches.size());
    EXPECT_EQ(looked_ahead.inliers.size(), 60U);
}

TEST(LoopDetector, GivesEveryVerdictOnceAndInOrderAndTheRestAtTheEnd)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_for_weak_pairs(2), kDimension, map);
    fild::StageTimes times;
    const std::vector<std::uint64_t> places{10, 11, 12, 13, 14, 15, 16, 10, 11, 12, 13, 14};
    constexpr std::size_t kUnusable = 8;
    std::vector<std::size_t> given;  // with each frame
    std::uint64_t next = 0;
    const auto take = [&](const std::vector<fild::DetectorOutcome>& outcomes)
    {
        given.push_back(outcomes.size());
        for (const auto& outcome : outcomes) EXPECT_EQ(outcome.verdict.frame, FrameId{next++});
    };
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        auto view = view_of(places[i], 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = 1000 + static_cast<double>(i);
        if (i == kUnusable) view.defect = Rejection::missing_image;
        take(detector.process(std::move(view), times));
    }
    take(detector.finish(times));
    // Frames 7, 9 and so on wait for 2 s; nothing can change the others.
    EXPECT_EQ(given, (std::vector<std::size_t>{1, 1, 1, 1, 1, 1, 1, 0, 0, 2, 0, 1, 2}));
    EXPECT_TRUE(detector.finish(times).empty());
}

TEST(LoopDetector, WithoutLookAheadAnswersAtOnce)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_for_weak_pairs(0), kDimension, map);
    fild::StageTimes times;
    for (std::uint64_t i = 0; i < 20; ++i)
    {
        auto view = view_of(10 + i % 7, 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = 1000 + static_cast<double>(i);
        EXPECT_EQ(detector.process(std::move(view), times).size(), 1U);
    }
    EXPECT_TRUE(detector.finish(times).empty());
    EXPECT_EQ(times.statistics().count("look_ahead"), 0U);
}

TEST(LoopDetector, RefusesABeliefWithoutEvidence)
{
    auto options = options_with_belief(2);
    options.same_place.enabled = false;
    fild::PlaceMap map;
    EXPECT_THROW(fild::LoopDetector(options, kDimension, map), std::invalid_argument);
    options.consistency.belief = false;
    options.candidates.follow_belief = true;
    EXPECT_THROW(fild::LoopDetector(options, kDimension, map), std::invalid_argument);
}

TEST(LoopDetector, VerifiesOneFrameOfAPlaceAndStopsAtTheFirstThatIsGood)
{
    const auto checked_with = [](int place_frames, bool stop_at_first)
    {
        auto options = options_with_delay(5);
        options.index.candidates = 4;
        options.candidates.place_frames = place_frames;
        options.candidates.stop_at_first = stop_at_first;
        const auto outcomes = drive(options, {10, 11, 20, 21, 22, 23, 24, 25, 10});
        EXPECT_TRUE(outcomes.back().verdict.accepted());
        std::size_t checked = 0;
        for (const auto& candidate : outcomes.back().considered) checked += candidate.checked;
        return checked;
    };
    EXPECT_EQ(checked_with(0, false), 4U);
    EXPECT_EQ(checked_with(1, false), 2U);
    EXPECT_EQ(checked_with(0, true), 1U);
}

/** Cells that only views of this place have. */
fild::CellCodes cells_of(std::uint64_t place)
{
    std::mt19937_64 generator(place);
    fild::CellCodes cells{4, 4, {}};
    cells.codes.bits = 256;
    cells.codes.words_per_code = 4;
    for (int i = 0; i < 4 * 4 * 4; ++i) cells.codes.words.push_back(generator());
    return cells;
}

// The descriptor of the return is that of another place; its cells are right.
TEST(LoopDetector, VerifiesThePlacesWhoseCellsAgreeBest)
{
    const std::vector<std::uint64_t> places = {10, 20, 30, 40, 50, 60, 70, 10};
    const auto show_cells = [&](std::size_t i, FrameDescription& view)
    {
        view.local.cells = cells_of(places[i]);
        if (i == 7) view.global = view_of(50, 0).global;
    };
    auto options = options_with_delay(2);
    options.global_descriptor.cell_layer = "map";
    options.index.candidates = 10;
    options.candidates.best_by_cells = 1;
    const auto outcome = drive(options, places, show_cells).back();
    ASSERT_TRUE(outcome.verdict.accepted());
    EXPECT_EQ(outcome.verdict.candidate->frame, FrameId{0});
    std::size_t checked = 0;
    for (const auto& candidate : outcome.considered) checked += candidate.checked;
    EXPECT_EQ(checked, 1U);
}

TEST(LoopDetector, ComparesCellsOnlyWhereThereAreSome)
{
    auto options = options_with_delay(2);
    options.candidates.best_by_cells = 1;
    fild::PlaceMap map;
    EXPECT_THROW(fild::LoopDetector(options, kDimension, map), std::invalid_argument);
}

TEST(LoopDetector, TellsOfAllItLookedAt)
{
    auto options = options_with_delay(2);
    options.candidates.neighbour_reach = 1;
    const auto outcome = drive(options, {10, 11, 12, 13, 10}).back();
    ASSERT_EQ(outcome.considered.size(), 3U);  // frames 0 to 2 are old enough
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(outcome.considered[i].rank, i + 1);
    const auto& best = outcome.considered.front();
    EXPECT_EQ(best.candidate.frame, FrameId{0});
    EXPECT_TRUE(best.checked);
    EXPECT_EQ(best.rejection, Rejection::none);
    EXPECT_EQ(best.inliers, outcome.verdict.inliers);
    EXPECT_EQ(best.support, outcome.verdict.support);
}

TEST(LoopDetector, KeepsTheNumberOfAFrameThatCannotBeUsed)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(1), kDimension, map);
    fild::StageTimes times;
    FrameDescription broken;
    broken.frame = FrameId{4};
    broken.defect = Rejection::missing_image;
    const auto outcome = detector.process(std::move(broken), times).front();
    EXPECT_EQ(outcome.verdict.frame, FrameId{4});
    EXPECT_EQ(outcome.verdict.rejection, Rejection::missing_image);
    EXPECT_EQ(map.size(), 0U);
}

/** Places 0, 1, 2, ..., and those again, each seen by two cameras: LEFT a second after the place
 *  before, RIGHT, which sees something else there, with a stamp that is a little older. Every
 *  second outcome is one of LEFT. */
std::vector<fild::DetectorOutcome> drive_with_two_cameras(const fild::TDetectorOptions& options,
                                                          std::uint64_t places)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    std::vector<fild::DetectorOutcome> outcomes;
    for (std::uint64_t i = 0; i < 2 * places; ++i)
        for (const bool is_left : {true, false})
        {
            auto view = view_of(10 + i % places + (is_left ? 0 : 1000), i < places ? 0 : 0.2);
            view.frame = FrameId{outcomes.size()};
            view.sensor_label = is_left ? "LEFT" : "RIGHT";
            view.timestamp = 1000 + static_cast<double>(i) - (is_left ? 0 : 0.05);
            outcomes.push_back(detector.process(std::move(view), times).front());
        }
    EXPECT_EQ(detector.clock_jumps(), 0U);
    return outcomes;
}

/** The numbers of the outcomes that are loop closures. */
std::vector<std::uint64_t> accepted(const std::vector<fild::DetectorOutcome>& outcomes)
{
    std::vector<std::uint64_t> frames;
    for (const auto& outcome : outcomes)
        if (outcome.verdict.accepted()) frames.push_back(to_index(outcome.verdict.frame));
    return frames;
}

TEST(LoopDetector, DelaysEachOfTwoCamerasByTheSameTime)
{
    for (const double frame_rate : {0, 1})
    {
        auto options = options_with_delay(4);
        options.index.frame_rate = frame_rate;
        const auto outcomes = drive_with_two_cameras(options, 6);
        for (const auto& outcome : outcomes)
        {
            const auto frame = to_index(outcome.verdict.frame);
            const auto& candidate = outcome.verdict.candidate;
            EXPECT_TRUE(!candidate || to_index(candidate->frame) / 2 + 4 <= frame / 2)
                << frame_rate;
            EXPECT_EQ(outcome.verdict.rejection == Rejection::too_early, frame < 8) << frame;
        }
        EXPECT_EQ(accepted(outcomes).size(), 12U);
    }
}

TEST(LoopDetector, CountsTheFramesInARowOfEachCamera)
{
    auto options = options_with_delay(4);
    options.consistency.consecutive_frames = 2;
    EXPECT_THAT(accepted(drive_with_two_cameras(options, 6)),
                testing::ElementsAre(14, 15, 16, 17, 18, 19, 20, 21, 22, 23));
}

// All eight frames that are old enough are nearest neighbours: four of each camera, one after the
// other.
TEST(LoopDetector, CountsTheFramesOfAPlaceOfEachCamera)
{
    auto options = options_with_delay(5);
    options.index.candidates = 8;
    options.candidates.place_frames = 1;
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    std::uint64_t frame = 0;
    std::vector<std::uint64_t> checked;
    for (const std::uint64_t place : {10, 11, 20, 21, 22, 23, 24, 25, 10})
        for (const std::string camera : {"LEFT", "RIGHT"})
        {
            auto view = view_of(place + (camera == "LEFT" ? 0 : 1000), 0.1);
            view.timestamp = 1000 + static_cast<double>(frame / 2);
            view.frame = FrameId{frame++};
            view.sensor_label = camera;
            const auto outcome = detector.process(std::move(view), times).front();
            if (frame != 17) continue;
            EXPECT_EQ(outcome.verdict.candidate->frame, FrameId{0});
            EXPECT_TRUE(outcome.verdict.accepted());
            for (const auto& each : outcome.considered)
                if (each.checked) checked.push_back(to_index(each.candidate.frame));
        }
    EXPECT_EQ(checked.size(), 4U);
    for (const auto a : checked)
        for (const auto b : checked) EXPECT_NE(a + 2, b) << "the next frame of a's camera";
}

/** LEFT has come back; the descriptor of RIGHT's frame at the same instant leads nowhere. */
TEST(LoopDetector, FollowsTheBeliefFromCameraToCamera)
{
    auto options = options_with_belief(5);
    options.index.candidates = 1;
    options.candidates.follow_belief = true;
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    std::vector<fild::FrameVerdict> verdicts;
    const std::vector<std::uint64_t> places{10, 20, 30, 10};
    for (std::size_t i = 0; i < places.size(); ++i)
        for (const bool is_left : {true, false})
        {
            auto view = view_of(places[i] + (is_left ? 0 : 1000), 0.1 * static_cast<double>(i));
            if (i == 3 && !is_left) view.global = view_of(1030, 0).global;
            view.frame = FrameId{verdicts.size()};
            view.sensor_label = is_left ? "LEFT" : "RIGHT";
            view.timestamp = i == 3 ? 10 : static_cast<double>(i);
            verdicts.push_back(detector.process(std::move(view), times).front().verdict);
        }
    ASSERT_TRUE(verdicts[6].accepted());
    ASSERT_TRUE(verdicts[7].accepted());
    EXPECT_EQ(verdicts[7].candidate->frame, FrameId{1});
}

TEST(LoopDetector, GoesOnWhenTheClockJumpsBack)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(2), kDimension, map);
    fild::StageTimes times;
    const std::vector<double> timestamps = {1000, 1001, 1002, 10, 11, 12};
    const std::vector<std::uint64_t> places = {10, 11, 12, 13, 14, 10};
    fild::DetectorOutcome last;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        auto view = view_of(places[i], 0.3 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = timestamps[i];
        last = detector.process(std::move(view), times).front();
    }
    EXPECT_EQ(detector.clock_jumps(), 1U);
    EXPECT_TRUE(last.verdict.accepted());
    EXPECT_EQ(last.verdict.candidate->frame, FrameId{0});
}

TEST(LoopDetector, DoesNotAnswerWithItsNeighbourhoodAfterAWrongStamp)
{
    for (const double wrong : {-60.0, 60.0})
    {
        fild::PlaceMap map;
        fild::LoopDetector detector(options_with_delay(20), kDimension, map);
        fild::StageTimes times;
        for (std::uint64_t i = 0; i < 100; ++i)
        {
            auto view = view_of(10, 0.01 * static_cast<double>(i));
            view.frame = FrameId{i};
            view.timestamp = 1000 + 0.1 * static_cast<double>(i) + (i == 30 ? wrong : 0);
            const auto outcome = detector.process(std::move(view), times).front();
            EXPECT_EQ(outcome.verdict.rejection, Rejection::too_early) << i;
        }
        EXPECT_EQ(detector.clock_jumps(), 1U);
    }
}

TEST(LoopDetector, BearsFramesWithoutFeatures)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(1), kDimension, map);
    fild::StageTimes times;
    for (std::uint64_t i = 0; i < 4; ++i)
    {
        auto view = view_of(10, 0);
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        view.local.positions.clear();
        view.local.codes.words.clear();
        const auto outcome = detector.process(std::move(view), times).front();
        EXPECT_EQ(outcome.verdict.rejection,
                  i == 0 ? Rejection::too_early : Rejection::too_few_matches);
    }
}

TEST(LoopDetector, RefusesFramesOutOfOrder)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(1), kDimension, map);
    fild::StageTimes times;
    auto view = view_of(10, 0);
    view.frame = FrameId{3};
    detector.process(view, times);
    EXPECT_THROW(detector.process(view, times), std::invalid_argument);
}

TEST(LoopDetector, RefusesAnotherLengthAtOnceAndGoesOn)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(1), kDimension, map);
    fild::StageTimes times;
    for (std::uint64_t i = 0; i < 4; ++i)
    {
        auto view = view_of(10, 0);
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        auto longer = view;
        longer.global.push_back(0);
        EXPECT_THROW(detector.process(std::move(longer), times), std::invalid_argument);
        const auto outcome = detector.process(std::move(view), times).front();
        EXPECT_EQ(outcome.verdict.accepted(), i > 0) << i;
    }
}

TEST(LoopDetector, TimesItsStagesAndWeighsItsMap)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options_with_delay(1), kDimension, map);
    fild::StageTimes times;
    for (std::uint64_t i = 0; i < 3; ++i)
    {
        auto view = view_of(10 + i, 0);
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        detector.process(std::move(view), times);
    }
    const auto statistics = times.statistics();
    EXPECT_EQ(statistics.at("index_insertion").calls, 2U);
    EXPECT_EQ(statistics.at("index_search").calls, 2U);
    EXPECT_EQ(statistics.at("matching").calls, 2U);
    EXPECT_EQ(statistics.at("verification").calls, 2U);
    EXPECT_EQ(map.bytes(), 3 * kPoints * (8 + 2 + 32 + 8));
    EXPECT_EQ(detector.descriptor_bytes(), 3 * kDimension * 4);
}

// Whitening keeps the descriptors of the index as they came, too.
TEST(LoopDetector, WeighsBothDescriptorsOfAWhitenedMap)
{
    auto options = options_with_delay(1);
    options.index.whiten_from = 2;
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    for (std::uint64_t i = 0; i < 4; ++i)
    {
        auto view = view_of(10 + i, 0);
        view.frame = FrameId{i};
        view.timestamp = static_cast<double>(i);
        detector.process(std::move(view), times);
    }
    constexpr std::size_t kInIndex = 3;
    EXPECT_EQ(detector.descriptor_bytes(), (2 * kInIndex + 1) * kDimension * 4);
}

/** Places in an order, with a stop of `stop` frames at the third of five; then the first again. */
std::vector<fild::DetectorOutcome> drive_with_a_stop(const fild::TDetectorOptions& options,
                                                     std::size_t stop)
{
    fild::PlaceMap map;
    fild::LoopDetector detector(options, kDimension, map);
    fild::StageTimes times;
    std::vector<std::uint64_t> places{10, 11};
    places.insert(places.end(), stop, 12);
    for (const std::uint64_t place : {13, 14, 10, 11, 12}) places.push_back(place);
    std::vector<fild::DetectorOutcome> outcomes;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        auto view =
            view_of(places[i], places[i] == 12 && i < stop + 2 ? 0 : 0.1 * static_cast<double>(i));
        view.frame = FrameId{i};
        view.timestamp = 1000 + static_cast<double>(i);
        for (auto& outcome : detector.process(std::move(view), times))
            outcomes.push_back(std::move(outcome));
    }
    for (auto& outcome : detector.finish(times)) outcomes.push_back(std::move(outcome));
    return outcomes;
}

// A robot that stands for longer than the delay does not return to where it stands.
TEST(LoopDetector, ARobotThatStandsStillReturnsToNoPlace)
{
    constexpr std::size_t kStop = 20;
    auto options = options_with_delay(4);
    options.candidates.neighbour_reach = 3;
    const auto accepted = [](const std::vector<fild::DetectorOutcome>& outcomes)
    {
        std::vector<std::size_t> frames;
        for (const auto& outcome : outcomes)
            if (outcome.verdict.accepted()) frames.push_back(to_index(outcome.verdict.frame));
        return frames;
    };
    EXPECT_GT(accepted(drive_with_a_stop(options, kStop)).size(), kStop / 2);
    options.index.still_seconds = 2;
    const auto outcomes = drive_with_a_stop(options, kStop);
    EXPECT_EQ(accepted(outcomes), (std::vector<std::size_t>{kStop + 4, kStop + 5, kStop + 6}));
    EXPECT_EQ(outcomes[kStop + 6].verdict.candidate->frame, FrameId{2}) << "where the stop began";
}

}  // namespace
