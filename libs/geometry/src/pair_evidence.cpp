// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/pair_evidence.h"

#include "fild/core/spread.h"
#include "fild/geometry/shape_agreement.h"

#include <opencv2/calib3d.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace fild
{
namespace
{
// All lengths are shares of the image's diagonal.
constexpr double kAffineError = 0.03;  // of an inlier that the affine map fits
constexpr double kBorder = 0.03;  // of the image's sides, where keypoints are missed
constexpr double kMaxScale = 5;
constexpr std::size_t kMapPairs = 200;  // inliers that a LocalMap keeps, evenly chosen
constexpr double kCloseBits = 0.2;  // share of a code's bits

double share(std::size_t part, std::size_t whole)
{
    return (static_cast<double>(part) + 1) / (static_cast<double>(whole) + 3);
}

double diagonal(const ImageSize& size)
{
    return std::hypot(size.width, size.height);
}

bool is_inside(const PixelPosition& p, const ImageSize& size)
{
    const auto x = static_cast<double>(p.x);
    const auto y = static_cast<double>(p.y);
    return x >= kBorder * size.width && y >= kBorder * size.height &&
           x < (1 - kBorder) * size.width && y < (1 - kBorder) * size.height;
}

double squared_distance(const PixelPosition& a, const PixelPosition& b)
{
    const double dx = static_cast<double>(a.x) - static_cast<double>(b.x);
    const double dy = static_cast<double>(a.y) - static_cast<double>(b.y);
    return dx * dx + dy * dy;
}

/** Takes positions of one image to the other: by the nearest of the pairs that are known, and a
 *  linear map for the way from it. */
class LocalMap
{
 public:
    LocalMap(std::vector<PixelPosition> from, std::vector<PixelPosition> to, cv::Matx22d linear)
        : from_(std::move(from)), to_(std::move(to)), linear_(linear)
    {
    }

    PixelPosition operator()(const PixelPosition& p) const
    {
        std::size_t nearest = 0;
        double least = squared_distance(p, from_.front());
        for (std::size_t k = 1; k < from_.size(); ++k)
            if (const double d = squared_distance(p, from_[k]); d < least)
            {
                least = d;
                nearest = k;
            }
        const cv::Vec2d way(static_cast<double>(p.x - from_[nearest].x),
                            static_cast<double>(p.y - from_[nearest].y));
        const cv::Vec2d moved = linear_ * way;
        return {to_[nearest].x + static_cast<float>(moved[0]),
                to_[nearest].y + static_cast<float>(moved[1])};
    }

    double scale() const { return std::sqrt(std::abs(cv::determinant(linear_))); }

    LocalMap inverse() const { return {to_, from_, linear_.inv()}; }

 private:
    std::vector<PixelPosition> from_;
    std::vector<PixelPosition> to_;
    cv::Matx22d linear_;
};

std::vector<PixelPosition> chosen(const std::vector<PixelPosition>& positions)
{
    std::vector<PixelPosition> kept;
    for (const auto k : spread_indices(kMapPairs, positions.size())) kept.push_back(positions[k]);
    return kept;
}

/** Candidate from query, by the inliers; none when no affine map fits them. */
std::optional<LocalMap> map_of_inliers(const MatchedPair& pair)
{
    std::vector<PixelPosition> from;
    std::vector<PixelPosition> to;
    std::vector<cv::Point2f> query;
    std::vector<cv::Point2f> candidate;
    for (const auto& match : pair.inliers)
    {
        from.push_back(pair.query.positions[match.query]);
        to.push_back(pair.candidate.positions[match.candidate]);
        query.emplace_back(from.back().x, from.back().y);
        candidate.emplace_back(to.back().x, to.back().y);
    }
    if (from.size() < 3) return std::nullopt;
    const cv::Mat affine = cv::estimateAffine2D(query,
                                                candidate,
                                                cv::noArray(),
                                                cv::RANSAC,
                                                kAffineError * diagonal(pair.candidate.image_size),
                                                500,
                                                0.99,
                                                5);
    if (affine.empty()) return std::nullopt;
    const cv::Matx23d m(affine);
    LocalMap map(chosen(from), chosen(to), {m(0, 0), m(0, 1), m(1, 0), m(1, 1)});
    if (map.scale() <= 1 / kMaxScale || map.scale() >= kMaxScale) return std::nullopt;
    return map;
}

std::size_t matches_in_overlap(const MatchedPair& pair, const LocalMap& map)
{
    const auto back = map.inverse();
    std::size_t seen = 0;
    for (const auto& match : pair.matches)
    {
        const auto there = map(pair.query.positions[match.query]);
        const auto here = back(pair.candidate.positions[match.candidate]);
        if (is_inside(there, pair.candidate.image_size) && is_inside(here, pair.query.image_size))
            ++seen;
    }
    return seen;
}

void require_shapes(const HashedFeatures& features)
{
    if (features.shapes.size() != features.positions.size() ||
        features.codes.size() != features.positions.size())
        throw std::invalid_argument("measure_evidence: keypoints without shape or code");
}

/** Matches at kCloseBits or less. */
std::size_t count_close(const std::vector<Match>& matches, int bits)
{
    std::size_t close = 0;
    for (const auto& match : matches) close += match.distance_bits <= kCloseBits * bits ? 1U : 0U;
    return close;
}
}  // namespace

EvidenceValues measure_evidence(const MatchedPair& pair)
{
    const auto& [query, candidate, matches, inliers, compared] = pair;
    require_shapes(query);
    require_shapes(candidate);
    const auto close = count_close(matches, query.codes.bits);
    const auto shape = dominant_shape(inliers, query.shapes, candidate.shapes, {});
    const auto map = map_of_inliers(pair);
    EvidenceValues values{};
    const auto set = [&](Evidence kind, double value) { values[to_index(kind)] = value; };
    set(Evidence::inlier_share, share(inliers.size(), matches.size()));
    set(Evidence::shape_share, share(shape.agreeing, inliers.size()));
    set(Evidence::match_share, share(matches.size(), compared));
    set(Evidence::close_share, share(close, matches.size()));
    set(Evidence::overlap_share,
        share(map ? matches_in_overlap(pair, *map) : matches.size(), matches.size()));
    return values;
}

}  // namespace fild
