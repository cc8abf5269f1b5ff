// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/core/whole_file.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Writes verdicts as rows of a CSV file (RFC 4180, LF line ends) that appears when it is whole:
 *
 *  `frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,rejection,support,depth_source`
 *
 *  frame and candidate are 0-based numbers of camera frames, candidate and similarity empty when
 * there was none; timestamp in seconds since the UNIX epoch, 6 decimals; accepted 0 or 1; rejection
 * a word of fild::Rejection, empty when accepted; support as in FrameVerdict, 6 decimals;
 * depth_source a word of fild::DepthSource. Not thread-safe: one caller at a time. */
class VerdictCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit VerdictCsv(const std::string& path);

    void add(const FrameVerdict& verdict, const std::string& depth_source);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

/** What a loop closure is to the map: the last columns of loops.csv. Value type. */
struct LoopRow
{
    /** x, y, z, metres, and yaw, pitch, roll, radians, of a pose; then of its standard deviations.
     */
    using PoseNumbers = std::array<double, 6>;

    /** Of the query's robot in the frame of the candidate's; nothing when it is not known. */
    std::optional<PoseNumbers> candidate_from_query;
    /** Where the scale is unknown: yaw, pitch and roll of that pose, radians, and the direction in
     *  which the camera moved, a unit vector in the axes of the candidate's robot. */
    struct Unscaled
    {
        std::array<double, 3> angles;
        std::array<double, 3> direction;
    };
    std::optional<Unscaled> unscaled;
    PoseNumbers deviations{};
    std::optional<double> weight;  ///< in the optimised graph; nothing when it is no edge of it
    std::string edge;  ///< `used`, or why the loop is no edge or has no weight
};

/** Writes accepted loops as rows of a CSV file that appears when it is whole: the columns of
 *  VerdictCsv, and
 *
 *  `x,y,z,yaw_deg,pitch_deg,roll_deg,sigma_x,sigma_y,sigma_z,sigma_yaw_deg,sigma_pitch_deg,`
 *  `sigma_roll_deg,weight,edge,direction_x,direction_y,direction_z`
 *
 *  with 6 decimals; fields of what is not known are empty. Not thread-safe: one caller at a time.
 */
class LoopCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit LoopCsv(const std::string& path);

    void add(const FrameVerdict& verdict, const std::string& depth_source, const LoopRow& loop);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

/** Writes the earlier frames that were looked at for each query as rows of a CSV file that appears
 *  when it is whole:
 *
 *  `frame,rank,candidate,similarity,checked,matches,inliers,rejection,support`, then one column for
 *  each kind of Evidence, `against_chance` and `against_look_alike` (PairOdds).
 *
 *  rank is the position among the answers of the index, from 1; empty for a frame that was verified
 *  but is not among them. checked is 0 or 1. The columns after it are empty when it is 0; rejection
 *  also when the pair was verified; evidence and odds also when [same_place] is off or the pair has
 *  too few inliers. support as in ConsideredCandidate. Not thread-safe: one caller at a time. */
class CandidateCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit CandidateCsv(const std::string& path);

    void add(FrameId frame, const std::vector<ConsideredCandidate>& considered);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

}  // namespace fild
