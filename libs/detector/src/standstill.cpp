// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/standstill.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace fild
{
namespace
{
constexpr float kRadius = 1.5F;  // pixels
constexpr double kDifferentBits = 0.2;  // of a code

/** Keypoints by squares of the image with sides of the radius. */
class Squares
{
 public:
    explicit Squares(const std::vector<PixelPosition>& positions) : positions_(positions)
    {
        for (std::size_t i = 0; i < positions.size(); ++i)
            squares_[key(column(positions[i].x), column(positions[i].y))].push_back(i);
    }

    /** True when a keypoint within the radius satisfies `is_wanted`. */
    template <class Wanted>
    bool has_near(const PixelPosition& position, Wanted&& is_wanted) const
    {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
            {
                const auto square =
                    squares_.find(key(column(position.x) + dx, column(position.y) + dy));
                if (square == squares_.end()) continue;
                for (const auto i : square->second)
                    if (is_near(positions_[i], position) && is_wanted(i)) return true;
            }
        return false;
    }

 private:
    static int column(float x) { return static_cast<int>(std::floor(x / kRadius)); }

    static std::int64_t key(int x, int y) { return std::int64_t{y} * 1000000 + x; }

    static bool is_near(const PixelPosition& a, const PixelPosition& b)
    {
        return std::hypot(a.x - b.x, a.y - b.y) <= kRadius;
    }

    const std::vector<PixelPosition>& positions_;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> squares_;
};
}  // namespace

double repeated_share(const HashedFeatures& before, const HashedFeatures& after)
{
    constexpr std::size_t kFewest = 20;
    if (before.positions.size() < kFewest || after.positions.size() < kFewest) return 0;
    const Squares squares(after.positions);
    const auto words = static_cast<std::size_t>(before.codes.words_per_code);
    const int limit = static_cast<int>(kDifferentBits * before.codes.bits);
    std::size_t repeated = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i)
    {
        const auto looks_alike = [&](std::size_t j)
        { return hamming_distance(before.codes.code(i), after.codes.code(j), words) <= limit; };
        if (squares.has_near(before.positions[i], looks_alike)) ++repeated;
    }
    return static_cast<double>(repeated) / static_cast<double>(before.positions.size());
}

std::optional<FrameId> Standstill::add(FrameId frame,
                                       const std::string& camera,
                                       const HashedFeatures& features,
                                       double now)
{
    constexpr double kSameView = 0.3;
    const double step = now - now_;
    now_ = now;
    if (least_seconds_ > 0)
    {
        const auto found = anchors_.find(camera);
        const bool is_same = found != anchors_.end() &&
                             repeated_share(found->second.features, features) >= kSameView;
        if (!is_same)
            anchors_[camera] = {frame, now, features};
        else if (now - found->second.now >= least_seconds_)
            return found->second.frame;
    }
    moving_seconds_ += step;
    return std::nullopt;
}

}  // namespace fild
