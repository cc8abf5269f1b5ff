// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

#include <cstddef>
#include <vector>

namespace fild
{
/** A point of a LanePath. */
struct LanePoint
{
    cv::Point2d position;  ///< m
    double heading = 0;  ///< rad, from x towards y, not wrapped
    double curvature = 0;  ///< of the heading by the way, rad/m; positive to the left
};

/** A line of lane centres: straight legs that meet at right angles, with rounded corners. In a
 *  corner the curvature rises and falls as 1 - cos, so that heading and curvature have no jumps.
 *  Const members may run concurrently. */
class LanePath
{
 public:
    /** \param vertices  where the legs would meet were the corners sharp; first and last are the
     *                   ends. At least two.
     *  \param corner_reach  from a vertex to where its corner begins and ends, m, > 0.
     *  \throw std::invalid_argument when legs do not meet at right angles or are too short for
     *         their corners. */
    LanePath(const std::vector<cv::Point2d>& vertices, double corner_reach);

    double length() const { return length_; }

    /** \param s  way from the beginning, m; clamped to [0, length()]. */
    LanePoint at(double s) const;

    /** Way to where the corner at `vertex` (not the first or last) begins, and ends. */
    double corner_begin(std::size_t vertex) const { return pieces_.at(2 * vertex - 1).begin; }
    double corner_end(std::size_t vertex) const { return pieces_.at(2 * vertex).begin; }

 private:
    /** A straight leg, or a corner. They take turns, beginning with a leg. */
    struct Piece
    {
        double begin = 0;  ///< way from the beginning of the path, m
        double length = 0;
        cv::Point2d from;
        double heading = 0;  ///< at its beginning
        double turn = 0;  ///< change of heading; 0: straight
    };

    void add(cv::Point2d from, double heading, double length, double turn);

    std::vector<Piece> pieces_;
    double length_ = 0;
};

}  // namespace fild
