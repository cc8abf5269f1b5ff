// SPDX-License-Identifier: BSD-3-Clause
#include "fild/places/place_map.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
std::size_t bytes_of(const HashedFeatures& features)
{
    return features.positions.size() * sizeof(PixelPosition) +
           features.shapes.size() * sizeof(KeypointShape) +
           features.codes.words.size() * sizeof(std::uint64_t) +
           features.codes.buckets.size() * sizeof(std::uint16_t) +
           features.cells.codes.words.size() * sizeof(std::uint64_t);
}

std::size_t bytes_of(const KeypointDepths& depths)
{
    return (depths.metres.size() + depths.deviations_m.size()) * sizeof(float);
}

bool is_seen_on_the_way_of(const Place& place, const Place& other)
{
    return place.sensor_label == other.sensor_label && !place.stands_since;
}
}  // namespace

void PlaceMap::append(FrameId frame, Place place)
{
    if (!entries_.empty() && frame <= entries_.back().frame)
        throw std::invalid_argument("PlaceMap: frame ids must increase");
    bytes_ += bytes_of(place.local) + bytes_of(place.metric.depths);
    entries_.push_back({frame, std::move(place)});
}

const Place* PlaceMap::find(FrameId frame) const
{
    const auto position = position_of(frame);
    return position == entries_.end() ? nullptr : &position->place;
}

const Place& PlaceMap::at(FrameId frame) const
{
    if (const auto* place = find(frame)) return *place;
    throw std::out_of_range("PlaceMap: no place of frame " + std::to_string(to_index(frame)));
}

std::optional<FrameId> PlaceMap::after(FrameId frame) const
{
    const auto& place = at(frame);
    for (auto i = std::next(position_of(frame)); i != entries_.end(); ++i)
        if (is_seen_on_the_way_of(i->place, place)) return i->frame;
    return std::nullopt;
}

std::optional<FrameId> PlaceMap::before(FrameId frame) const
{
    const auto& place = at(frame);
    for (auto i = position_of(frame); i != entries_.begin();)
        if (is_seen_on_the_way_of((--i)->place, place)) return i->frame;
    return std::nullopt;
}

PlaceMap::Position PlaceMap::position_of(FrameId frame) const
{
    const auto position =
        std::lower_bound(entries_.begin(),
                         entries_.end(),
                         frame,
                         [](const Entry& entry, FrameId wanted) { return entry.frame < wanted; });
    return position != entries_.end() && position->frame == frame ? position : entries_.end();
}

}  // namespace fild
