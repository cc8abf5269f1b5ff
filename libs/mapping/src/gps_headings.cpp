// SPDX-License-Identifier: BSD-3-Clause
#include "gps_headings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** Boxes around each 256 positions in a row: while the robot is parked whole blocks are near. */
class PositionBlocks
{
 public:
    explicit PositionBlocks(const std::vector<Eigen::Vector3d>& positions)
        : count_(positions.size())
    {
        for (std::size_t i = 0; i < count_; ++i)
        {
            if (i % kBlock == 0) boxes_.emplace_back();
            boxes_.back().extend(Eigen::Vector2d(positions[i].head<2>()));
        }
    }

    /** True when all positions of the block are nearer than `radius`. */
    bool is_within(std::size_t position, const Eigen::Vector2d& centre, double radius) const
    {
        const auto& box = boxes_[position / kBlock];
        const Eigen::Vector2d furthest =
            (centre - box.min()).cwiseAbs().cwiseMax((centre - box.max()).cwiseAbs());
        return furthest.norm() < radius;
    }

    /** The last position before the block; 0 when there is none. */
    std::size_t before(std::size_t position) const
    {
        const auto begin = position / kBlock * kBlock;
        return begin > 0 ? begin - 1 : 0;
    }

    /** The first position after the block; the last one when there is none. */
    std::size_t after(std::size_t position) const
    {
        return std::min((position / kBlock + 1) * kBlock, count_ - 1);
    }

 private:
    static constexpr std::size_t kBlock = 256;

    std::size_t count_;
    std::vector<Eigen::AlignedBox2d> boxes_;
};

/** Direction of the movement about a position, where the positions around it are a baseline apart,
 *  or half of one at the ends of the drive. */
std::optional<Heading> heading_at(const std::vector<Eigen::Vector3d>& positions,
                                  const PositionBlocks& blocks,
                                  std::size_t index,
                                  double baseline)
{
    const Eigen::Vector2d here = positions[index].head<2>();
    const auto is_away = [&](std::size_t other)
    { return (positions[other].head<2>() - here).norm() >= baseline / 2; };
    std::size_t before = index;
    while (before > 0 && !is_away(before))
        before = blocks.is_within(before, here, baseline / 2) ? blocks.before(before) : before - 1;
    std::size_t after = index;
    while (after + 1 < positions.size() && !is_away(after))
        after = blocks.is_within(after, here, baseline / 2) ? blocks.after(after) : after + 1;
    const Eigen::Vector2d way = (positions[after] - positions[before]).head<2>();
    if (way.norm() < baseline / 2) return std::nullopt;
    return Heading{std::atan2(way.y(), way.x()), way.norm()};
}
}  // namespace

std::vector<std::optional<Heading>> headings_of(const std::vector<Eigen::Vector3d>& positions,
                                                double baseline_m)
{
    std::vector<std::optional<Heading>> headings;
    headings.reserve(positions.size());
    const PositionBlocks blocks(positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        headings.push_back(heading_at(positions, blocks, i, baseline_m));
    for (std::size_t i = 1; i < headings.size(); ++i)
        if (!headings[i]) headings[i] = headings[i - 1];
    for (std::size_t i = headings.size(); i-- > 1;)
        if (!headings[i - 1]) headings[i - 1] = headings[i];
    return headings;
}

}  // namespace fild
