// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/overlap_loops.h"

#include "fild/core/angle.h"

#include <mrpt/poses/CPose3D.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace fild
{
namespace
{
using mrpt::poses::CPose3D;

constexpr int kGridColumns = 40;  // of the pixels that stand for a frame
constexpr int kKeptColumns = 80;  // of the depth that is kept of a frame
constexpr double kDepthTolerance = 0.03;  // share of the depth ...
constexpr double kDepthToleranceM = 0.1;  // ... plus so many metres

/** What is kept of a frame. */
struct SeenFrame
{
    double seconds = 0;
    CPose3D map_from_camera;
    std::vector<cv::Point3f> points;  ///< of the camera: x right, y down, z forward
    cv::Mat depth;  ///< every kept_step()-th pixel, as kept_camera() sees them
};

/** Every how many pixels a depth is kept; at least two rows and columns are. */
int kept_step(const CameraModel& camera)
{
    return std::max(1,
                    std::min({camera.width / kKeptColumns, camera.width / 2, camera.height / 2}));
}

/** The camera whose pixels are those that are kept. */
CameraModel kept_camera(const CameraModel& camera)
{
    const int step = kept_step(camera);
    const int first = step / 2;
    auto kept = camera;
    kept.width = (camera.width - first + step - 1) / step;
    kept.height = (camera.height - first + step - 1) / step;
    kept.fx /= step;
    kept.fy /= step;
    kept.cx = (camera.cx - first) / step;
    kept.cy = (camera.cy - first) / step;
    return kept;
}

cv::Mat kept_depth(const CameraModel& camera, const cv::Mat& depth)
{
    const int step = kept_step(camera);
    const auto size = kept_camera(camera);
    cv::Mat kept(size.height, size.width, CV_32FC1);
    for (int v = 0; v < kept.rows; ++v)
        for (int u = 0; u < kept.cols; ++u)
            kept.at<float>(v, u) = depth.at<float>(step / 2 + v * step, step / 2 + u * step);
    return kept;
}

std::vector<cv::Point3f> grid_points(const CameraModel& camera, const cv::Mat& depth)
{
    const int step = std::max(1, camera.width / kGridColumns);
    std::vector<cv::Point3f> points;
    for (int v = step / 2; v < depth.rows; v += step)
        for (int u = step / 2; u < depth.cols; u += step)
        {
            const auto z = static_cast<double>(depth.at<float>(v, u));
            if (z > 0)
                points.emplace_back(
                    (u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z);
        }
    return points;
}

bool agrees(double depth, double z)
{
    return depth > 0 && std::abs(depth - z) <= kDepthTolerance * z + kDepthToleranceM;
}

/** Depth between four pixels: on a plane, 1 / depth is linear in the image. 0 when one has none. */
double interpolated_depth(const cv::Mat& depth, double u, double v)
{
    const int left = std::min(static_cast<int>(u), depth.cols - 2);
    const int top = std::min(static_cast<int>(v), depth.rows - 2);
    double inverse = 0;
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx)
        {
            const auto corner = static_cast<double>(depth.at<float>(top + dy, left + dx));
            if (corner <= 0) return 0;
            const double weight = (1 - std::abs(u - left - dx)) * (1 - std::abs(v - top - dy));
            inverse += weight / corner;
        }
    return 1 / inverse;
}

/** True when a point in space, in the camera's axes, is what the camera sees where it projects. */
bool sees(const CameraModel& camera, const cv::Mat& depth, const cv::Point3d& point)
{
    if (point.z <= 0) return false;
    const double u = camera.fx * point.x / point.z + camera.cx;
    const double v = camera.fy * point.y / point.z + camera.cy;
    if (u < 0 || v < 0 || u > camera.width - 1 || v > camera.height - 1) return false;
    const auto nearest = static_cast<double>(depth.at<float>(cvRound(v), cvRound(u)));
    return agrees(nearest, point.z) || agrees(interpolated_depth(depth, u, v), point.z);
}

cv::Point3d axis_of(const CPose3D& map_from_camera)
{
    const auto ahead = map_from_camera.rotateVector({0, 0, 1});
    return {ahead.x, ahead.y, ahead.z};
}

/** Share of the pixels of `shown` that `seer` sees. \param camera, depth  of `seer`. */
double overlap_of(const CameraModel& camera,
                  const SeenFrame& seer,
                  const cv::Mat& depth,
                  const SeenFrame& shown)
{
    if (shown.points.empty()) return 0;
    const auto seer_from_shown = shown.map_from_camera - seer.map_from_camera;
    const auto seen = std::count_if(
        shown.points.begin(),
        shown.points.end(),
        [&](const cv::Point3f& p)
        {
            const auto point = seer_from_shown.composePoint(mrpt::math::TPoint3D(
                static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)));
            return sees(camera, depth, {point.x, point.y, point.z});
        });
    return static_cast<double>(seen) / static_cast<double>(shown.points.size());
}
}  // namespace

struct OverlapLoops::State
{
    /** A query and an earlier frame, as far as their poses say. */
    struct Geometry
    {
        double metres = 0;  ///< between the cameras
        double cos_angle = 0;  ///< of the angle between the optical axes

        bool within(double max_metres, double max_deg) const
        {
            return metres <= max_metres && cos_angle >= std::cos(max_deg * kRadiansPerDegree);
        }
    };
    static Geometry geometry(const SeenFrame& query, const SeenFrame& candidate);
    void compare(const LoopPair& ids, const SeenFrame& query, const cv::Mat& query_depth);

    TTruthOptions options;
    CameraModel camera;
    CameraModel coarse_camera;  ///< of SeenFrame::depth
    std::vector<SeenFrame> frames;
    std::vector<LoopPair> pairs;
    std::vector<LoopPair> doubtful_pairs;
};

OverlapLoops::State::Geometry OverlapLoops::State::geometry(const SeenFrame& query,
                                                            const SeenFrame& candidate)
{
    const auto& a = query.map_from_camera;
    const auto& b = candidate.map_from_camera;
    return {a.distanceTo(b), axis_of(a).dot(axis_of(b))};
}

/** Files the pair under loops, doubtful pairs or, when it is wrong, nowhere. */
void OverlapLoops::State::compare(const LoopPair& ids,
                                  const SeenFrame& query,
                                  const cv::Mat& query_depth)
{
    const auto& candidate = frames[to_index(ids.candidate)];
    if (query.seconds - candidate.seconds < options.min_age_seconds) return;
    const auto apart = geometry(query, candidate);
    const bool may_be_loop = apart.within(options.max_distance_m, options.max_angle_deg);
    const bool is_near =
        apart.within(options.doubtful_max_distance_m, options.doubtful_max_angle_deg);
    const bool may_overlap =
        apart.within(options.doubtful_overlap_distance_m, options.doubtful_overlap_angle_deg);
    if (!may_be_loop && !is_near && !may_overlap) return;
    auto pair = ids;
    pair.overlap = std::max(overlap_of(camera, query, query_depth, candidate),
                            overlap_of(coarse_camera, candidate, candidate.depth, query));
    if (may_be_loop && pair.overlap >= options.overlap)
        pairs.push_back(pair);
    else if (is_near || (may_overlap && pair.overlap >= options.doubtful_overlap))
        doubtful_pairs.push_back(pair);
}

OverlapLoops::OverlapLoops(const TTruthOptions& options, const CameraModel& camera)
    : state_(std::make_unique<State>())
{
    options.check();
    if (camera.lens != LensModel::none || camera.width < 2 || camera.height < 2)
        throw std::invalid_argument("OverlapLoops: the camera is no pinhole of 2x2 pixels or more");
    state_->options = options;
    state_->camera = camera;
    state_->coarse_camera = kept_camera(camera);
}

OverlapLoops::~OverlapLoops() = default;

void OverlapLoops::add(double seconds,
                       const mrpt::math::TPose3D& map_from_camera,
                       const cv::Mat& depth)
{
    const auto& camera = state_->camera;
    if (depth.type() != CV_32FC1 || depth.cols != camera.width || depth.rows != camera.height)
        throw std::invalid_argument("OverlapLoops::add: depth is not float of the camera's size");
    SeenFrame query{
        seconds, CPose3D(map_from_camera), grid_points(camera, depth), kept_depth(camera, depth)};
    const FrameId query_id{state_->frames.size()};
    for (std::size_t i = 0; i < state_->frames.size(); ++i)
        state_->compare({query_id, FrameId{i}, 0}, query, depth);
    state_->frames.push_back(std::move(query));
}

const std::vector<LoopPair>& OverlapLoops::pairs() const
{
    return state_->pairs;
}

const std::vector<LoopPair>& OverlapLoops::doubtful_pairs() const
{
    return state_->doubtful_pairs;
}

void TTruthOptions::describe(OptionVisitor& visitor)
{
    visitor.real("overlap", overlap, 0.01, 1);
    visitor.real("min_age_seconds", min_age_seconds, 0, 1e6);
    visitor.real("max_distance_m", max_distance_m, 0, 1000);
    visitor.real("max_angle_deg", max_angle_deg, 0, 180);
    visitor.real("doubtful_overlap", doubtful_overlap, 0.01, 1);
    visitor.real("doubtful_overlap_distance_m", doubtful_overlap_distance_m, 0, 1000);
    visitor.real("doubtful_overlap_angle_deg", doubtful_overlap_angle_deg, 0, 180);
    visitor.real("doubtful_max_distance_m", doubtful_max_distance_m, 0, 1000);
    visitor.real("doubtful_max_angle_deg", doubtful_max_angle_deg, 0, 180);
}

void write_loops(std::ostream& out,
                 const TTruthOptions& options,
                 const std::vector<LoopPair>& pairs,
                 const std::vector<LoopPair>& doubtful_pairs)
{
    out << "# query candidate (0-based camera frames; the candidate is the earlier one)\n"
        << "# the share `overlap` or more of one frame's pixels is seen in the other;";
    for (const auto& [key, value] : options.values()) out << " " << key << "=" << value;
    out << "\n# a third word 0: the pair is doubtful, neither right nor wrong; the frames share"
        << "\n# `doubtful_overlap` or more in either direction, or are within"
        << "\n# doubtful_max_distance_m and doubtful_max_angle_deg"
        << "\n# without a line: a pair of min_age_seconds or more is wrong\n";
    for (const auto& pair : pairs)
        out << to_index(pair.query) << " " << to_index(pair.candidate) << "\n";
    for (const auto& pair : doubtful_pairs)
        out << to_index(pair.query) << " " << to_index(pair.candidate) << " 0\n";
}

}  // namespace fild
