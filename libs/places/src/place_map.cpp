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

bool is_on_the_way_of(const std::string& camera, const Place& place)
{
    return place.sensor_label == camera && !place.stands_since;
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
        if (is_on_the_way_of(place.sensor_label, i->place)) return i->frame;
    return std::nullopt;
}

std::optional<FrameId> PlaceMap::before(FrameId frame) const
{
    const auto& place = at(frame);
    for (auto i = position_of(frame); i != entries_.begin();)
        if (is_on_the_way_of(place.sensor_label, (--i)->place)) return i->frame;
    return std::nullopt;
}

FrameId PlaceMap::seen_by(const std::string& camera, FrameId frame) const
{
    const auto instant = at(frame).instant;
    const auto is_of_instant = [instant](const Entry& entry)
    { return entry.place.instant == instant; };
    auto i = position_of(frame);
    while (i != entries_.begin() && is_of_instant(*std::prev(i))) --i;
    for (; i != entries_.end() && is_of_instant(*i); ++i)
        if (is_on_the_way_of(camera, i->place)) return i->frame;
    return frame;
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
