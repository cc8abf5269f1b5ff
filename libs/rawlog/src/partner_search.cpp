// SPDX-License-Identifier: BSD-3-Clause
#include "partner_search.h"

#include "fild/core/upper_median.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr std::size_t kMostWaiting = 8;

}  // namespace

double PartnerSearch::tolerance() const
{
    return std::min(tolerance_, largest_tolerance().value_or(tolerance_));
}

std::optional<double> PartnerSearch::largest_tolerance() const
{
    if (left_gaps_.empty()) return std::nullopt;
    return upper_median({left_gaps_.begin(), left_gaps_.end()}) / 2;
}

std::optional<double> PartnerSearch::usual_miss() const
{
    if (misses_.empty()) return std::nullopt;
    return upper_median(misses_);
}

void PartnerSearch::note_time(StereoSide side, double seconds)
{
    constexpr std::size_t kMostGaps = 15;
    auto& own = side_of(side);
    auto& last = own.last;
    if (side == StereoSide::left && last && seconds > *last)
    {
        left_gaps_.push_back(seconds - *last);
        if (left_gaps_.size() > kMostGaps) left_gaps_.pop_front();
    }
    last = seconds;
    ++own.since_pair;
    if (side == StereoSide::left) return;
    for (auto& waiting : left_.queue)
        waiting.nearest =
            std::min(waiting.nearest.value_or(HUGE_VAL), std::abs(seconds - waiting.seconds));
}

std::optional<std::size_t> PartnerSearch::nearest_in(const Queue& queue,
                                                     double seconds,
                                                     double tolerance)
{
    const auto distance = [&](const Waiting& waiting)
    { return std::abs(waiting.seconds - seconds); };
    const auto nearest = std::min_element(queue.begin(),
                                          queue.end(),
                                          [&](const Waiting& a, const Waiting& b)
                                          { return distance(a) < distance(b); });
    if (nearest == queue.end() || distance(*nearest) > tolerance) return std::nullopt;
    return static_cast<std::size_t>(nearest - queue.begin());
}

void PartnerSearch::give_up(StereoSide side, std::size_t count, std::vector<ImagePair>& done)
{
    auto& own = side_of(side);
    auto& queue = own.queue;
    for (; count > 0; --count)
    {
        const auto& first = queue.front();
        if (side == StereoSide::left)
        {
            done.push_back({first.image, nullptr});
            if (first.nearest) misses_.push_back(*first.nearest);
        }
        ++own.alone;
        queue.pop_front();
    }
}

/** The images of a side come in the order of their time. */
void PartnerSearch::give_up_hopeless(std::vector<ImagePair>& done)
{
    const auto is_hopeless = [this](const Side& own, const Side& other)
    {
        const auto& queue = own.queue;
        if (queue.empty()) return false;
        const bool is_past = other.last && *other.last > queue.front().seconds + tolerance();
        return queue.size() > kMostWaiting || is_past;
    };
    while (is_hopeless(left_, right_)) give_up(StereoSide::left, 1, done);
    while (is_hopeless(right_, left_)) give_up(StereoSide::right, 1, done);
}

std::vector<ImagePair> PartnerSearch::add(StereoSide side, const SingleImage& image)
{
    std::vector<ImagePair> done;
    const bool is_left = side == StereoSide::left;
    auto& own = side_of(side).queue;
    auto& others = (is_left ? right_ : left_).queue;
    if (image->timestamp == INVALID_TIMESTAMP)
    {
        own.push_back({image, 0, std::nullopt});
        give_up(side, own.size(), done);
        return done;
    }
    const double seconds = mrpt::Clock::toDouble(image->timestamp);
    note_time(side, seconds);
    const auto partner = nearest_in(others, seconds, tolerance());
    if (!partner)
    {
        std::optional<double> nearest;
        if (is_left && right_.last) nearest = std::abs(*right_.last - seconds);
        own.push_back({image, seconds, nearest});
        give_up_hopeless(done);
        return done;
    }
    give_up(side, own.size(), done);
    give_up(is_left ? StereoSide::right : StereoSide::left, *partner, done);
    const auto other = others.front().image;
    others.pop_front();
    done.push_back(is_left ? ImagePair{image, other} : ImagePair{other, image});
    ++paired_;
    left_.since_pair = left_.queue.size();
    right_.since_pair = right_.queue.size();
    give_up_hopeless(done);
    return done;
}

std::vector<ImagePair> PartnerSearch::finish()
{
    std::vector<ImagePair> done;
    give_up(StereoSide::left, left_.queue.size(), done);
    give_up(StereoSide::right, right_.queue.size(), done);
    return done;
}

}  // namespace fild
