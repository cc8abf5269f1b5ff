// SPDX-License-Identifier: BSD-3-Clause
#include "fild/places/place_map.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace
{
using fild::FrameId;
using fild::Place;
using fild::PlaceMap;

Place place_of(const std::string& camera)
{
    Place place;
    place.sensor_label = camera;
    return place;
}

TEST(PlaceMap, FindsPlacesByTheirFrames)
{
    PlaceMap map;
    EXPECT_EQ(map.find(FrameId{0}), nullptr);
    for (const std::uint64_t id : {0, 3, 4, 9})
    {
        auto place = place_of("LEFT");
        place.timestamp = 100.0 + static_cast<double>(id);
        map.append(FrameId{id}, place);
    }
    EXPECT_EQ(map.size(), 4U);
    for (const std::uint64_t id : {0, 3, 4, 9})
        EXPECT_EQ(map.at(FrameId{id}).timestamp, 100.0 + static_cast<double>(id));
    for (const std::uint64_t id : {1, 5, 10}) EXPECT_EQ(map.find(FrameId{id}), nullptr) << id;
    EXPECT_THROW(map.at(FrameId{5}), std::out_of_range);
}

TEST(PlaceMap, TakesFramesInTheirOrderOnly)
{
    PlaceMap map;
    map.append(FrameId{7}, place_of("LEFT"));
    EXPECT_THROW(map.append(FrameId{7}, place_of("LEFT")), std::invalid_argument);
    EXPECT_THROW(map.append(FrameId{6}, place_of("LEFT")), std::invalid_argument);
    EXPECT_EQ(map.size(), 1U);
}

TEST(PlaceMap, LeavesAPlaceWhereItIs)
{
    PlaceMap map;
    map.append(FrameId{0}, place_of("LEFT"));
    const auto* first = map.find(FrameId{0});
    for (std::uint64_t id = 1; id < 1000; ++id) map.append(FrameId{id}, place_of("LEFT"));
    EXPECT_EQ(map.find(FrameId{0}), first);
}

TEST(PlaceMap, FollowsTheWayOfOneCamera)
{
    PlaceMap map;
    map.append(FrameId{0}, place_of("LEFT"));
    map.append(FrameId{1}, place_of("RIGHT"));
    auto standing = place_of("LEFT");
    standing.stands_since = FrameId{0};
    map.append(FrameId{2}, standing);
    map.append(FrameId{5}, place_of("LEFT"));
    EXPECT_EQ(map.after(FrameId{0}), FrameId{5});
    EXPECT_EQ(map.before(FrameId{5}), FrameId{0});
    EXPECT_EQ(map.after(FrameId{2}), FrameId{5});
    EXPECT_EQ(map.before(FrameId{2}), FrameId{0});
    EXPECT_EQ(map.before(FrameId{0}), std::nullopt);
    EXPECT_EQ(map.after(FrameId{5}), std::nullopt);
    EXPECT_EQ(map.after(FrameId{1}), std::nullopt);
    EXPECT_THROW(map.after(FrameId{3}), std::out_of_range);
}

TEST(PlaceMap, FindsWhatAnotherCameraSawAtTheSameInstant)
{
    PlaceMap map;
    for (std::uint64_t id = 0; id < 6; ++id)
    {
        auto place = place_of(id % 2 == 0 ? "LEFT" : "RIGHT");
        place.instant = 1 + id / 2;
        if (id == 5) place.stands_since = FrameId{3};
        map.append(FrameId{id}, place);
    }
    EXPECT_EQ(map.seen_by("RIGHT", FrameId{2}), FrameId{3});
    EXPECT_EQ(map.seen_by("LEFT", FrameId{3}), FrameId{2});
    EXPECT_EQ(map.seen_by("LEFT", FrameId{2}), FrameId{2});
    EXPECT_EQ(map.seen_by("BACK", FrameId{2}), FrameId{2}) << "there is no such camera";
    EXPECT_EQ(map.seen_by("RIGHT", FrameId{4}), FrameId{4}) << "it stands still";
}

TEST(PlaceMap, CountsTheMemoryOfItsPlaces)
{
    PlaceMap map;
    auto place = place_of("LEFT");
    place.local.positions.resize(100);
    place.local.shapes.resize(100);
    place.local.codes.words.resize(400);
    place.metric.depths.metres.resize(100);
    map.append(FrameId{0}, place);
    constexpr std::size_t kOfOneKeypoint = 2 * sizeof(float) + 2 + 4 * 8 + sizeof(float);
    EXPECT_EQ(map.bytes(), 100 * kOfOneKeypoint);
    map.append(FrameId{1}, place);
    EXPECT_EQ(map.bytes(), 2 * 100 * kOfOneKeypoint);
}
}  // namespace
