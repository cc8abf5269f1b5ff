// SPDX-License-Identifier: BSD-3-Clause
#include "row_matches.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace fild
{
namespace
{
constexpr double kSamePlacePx = 3;

int distance_bits(const BinaryCodes& a, std::size_t i, const BinaryCodes& b, std::size_t k)
{
    std::size_t bits = 0;
    for (int w = 0; w < a.words_per_code; ++w)
        bits += std::bitset<64>(a.code(i)[w] ^ b.code(k)[w]).count();
    return static_cast<int>(bits);
}

/** Keypoints by the whole number of their row. */
using Rows = std::map<int, std::vector<std::size_t>>;

Rows by_row(const std::vector<cv::Point2d>& pixels)
{
    Rows rows;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        rows[static_cast<int>(std::floor(pixels[i].y))].push_back(i);
    return rows;
}

struct Neighbour
{
    std::size_t index = 0;
    int bits = 0;
};

/** The nearest of `found`, unless another place is as near but for the ratio. */
std::optional<Neighbour> clearly_nearest(const std::vector<Neighbour>& found,
                                         const std::vector<cv::Point2d>& pixels,
                                         double ratio)
{
    if (found.empty()) return std::nullopt;
    const auto best =
        *std::min_element(found.begin(),
                          found.end(),
                          [](const Neighbour& a, const Neighbour& b)
                          { return a.bits != b.bits ? a.bits < b.bits : a.index < b.index; });
    for (const auto& other : found)
        if (std::abs(pixels[other.index].x - pixels[best.index].x) > kSamePlacePx &&
            best.bits > ratio * other.bits)
            return std::nullopt;
    return best;
}

/** One image's keypoints, for the search from a keypoint of the other. */
class Side
{
 public:
    Side(const std::vector<cv::Point2d>& pixels, const BinaryCodes& codes)
        : pixels_(pixels), codes_(codes), rows_(by_row(pixels))
    {
    }

    /** \param sign  +1: this is the right image, whose points lie to the left; -1: the left. */
    std::optional<Neighbour> nearest_to(const Side& other,
                                        std::size_t i,
                                        double sign,
                                        const RowSearch& search) const
    {
        const auto& pixel = other.pixels_[i];
        const auto first =
            rows_.lower_bound(static_cast<int>(std::floor(pixel.y - search.max_row_error_px)));
        const auto last =
            rows_.upper_bound(static_cast<int>(std::floor(pixel.y + search.max_row_error_px)));
        std::vector<Neighbour> found;
        for (auto row = first; row != last; ++row)
            for (const auto k : row->second)
            {
                const double disparity = sign * (pixel.x - pixels_[k].x);
                if (disparity > 0 && disparity <= search.max_disparity_px &&
                    std::abs(pixel.y - pixels_[k].y) <= search.max_row_error_px)
                    found.push_back({k, distance_bits(other.codes_, i, codes_, k)});
            }
        return clearly_nearest(found, pixels_, search.ratio);
    }

 private:
    const std::vector<cv::Point2d>& pixels_;
    const BinaryCodes& codes_;
    Rows rows_;
};
}  // namespace

std::vector<Match> match_on_rows(const std::vector<cv::Point2d>& left,
                                 const BinaryCodes& left_codes,
                                 const std::vector<cv::Point2d>& right,
                                 const BinaryCodes& right_codes,
                                 const RowSearch& search)
{
    const Side left_side(left, left_codes);
    const Side right_side(right, right_codes);
    std::vector<Match> matches;
    for (std::size_t i = 0; i < left.size(); ++i)
    {
        const auto there = right_side.nearest_to(left_side, i, 1, search);
        if (!there) continue;
        const auto back = left_side.nearest_to(right_side, there->index, -1, search);
        if (back && back->index == i) matches.push_back({i, there->index, there->bits});
    }
    return matches;
}

}  // namespace fild
