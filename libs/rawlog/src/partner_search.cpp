// SPDX-License-Identifier: BSD-3-Clause
#include "partner_search.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr std::size_t kMostWaiting = 8;

template <class Numbers>
std::optional<double> median_of(const Numbers& numbers)
{
    if (numbers.empty()) return std::nullopt;
    std::vector<double> sorted(numbers.begin(), numbers.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}
}  // namespace

double PartnerSearch::tolerance() const
{
    return std::min(tolerance_, largest_tolerance().value_or(tolerance_));
}

std::optional<double> PartnerSearch::largest_tolerance() const
{
    const auto gap = median_of(left_gaps_);
    if (!gap) return std::nullopt;
    return *gap / 2;
}

std::optional<double> PartnerSearch::usual_miss() const
{
    return median_of(misses_);
}

void PartnerSearch::note_time(StereoSide side, double seconds)
{
    constexpr std::size_t kMostGaps = 15;
    auto& last = side == StereoSide::left ? last_left_ : last_right_;
    if (side == StereoSide::left && last && seconds > *last)
    {
        left_gaps_.push_back(seconds - *last);
        if (left_gaps_.size() > kMostGaps) left_gaps_.pop_front();
    }
    last = seconds;
    ++(side == StereoSide::left ? left_since_pair_ : right_since_pair_);
    if (side == StereoSide::left) return;
    for (auto& waiting : left_)
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
    auto& queue = side == StereoSide::left ? left_ : right_;
    for (; count > 0; --count)
    {
        const auto& first = queue.front();
        if (side == StereoSide::left)
        {
            done.push_back({first.image, nullptr});
            if (first.nearest) misses_.push_back(*first.nearest);
            ++left_alone_;
        }
        else
            ++right_alone_;
        queue.pop_front();
    }
}

/** The images of a side come in the order of their time. */
void PartnerSearch::give_up_hopeless(std::vector<ImagePair>& done)
{
    const auto is_past = [this](const Queue& queue, const std::optional<double>& other)
    { return other && *other > queue.front().seconds + tolerance(); };
    while (!left_.empty() && (left_.size() > kMostWaiting || is_past(left_, last_right_)))
        give_up(StereoSide::left, 1, done);
    while (!right_.empty() && (right_.size() > kMostWaiting || is_past(right_, last_left_)))
        give_up(StereoSide::right, 1, done);
}

std::vector<ImagePair> PartnerSearch::add(StereoSide side, const SingleImage& image)
{
    std::vector<ImagePair> done;
    const bool is_left = side == StereoSide::left;
    auto& own = is_left ? left_ : right_;
    auto& others = is_left ? right_ : left_;
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
        if (is_left && last_right_) nearest = std::abs(*last_right_ - seconds);
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
    left_since_pair_ = left_.size();
    right_since_pair_ = right_.size();
    give_up_hopeless(done);
    return done;
}

std::vector<ImagePair> PartnerSearch::finish()
{
    std::vector<ImagePair> done;
    give_up(StereoSide::left, left_.size(), done);
    give_up(StereoSide::right, right_.size(), done);
    return done;
}

}  // namespace fild
