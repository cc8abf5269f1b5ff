// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"
#include "fild/core/verdict.h"
#include "fild/render/picture_view.h"
#include "fild/render/render_options.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
struct MapContent;

/** Where the robot was at a frame. Value type. */
struct PlacedFrame
{
    FrameId frame{};
    RigidTransform map_from_robot;  ///< metres
    int segment = 0;  ///< between two segments the motion is unknown: no line joins them
};

/** What the ground truth says of a loop closure. */
enum class LoopTruthMark
{
    unknown,  ///< there is no ground truth
    right,
    wrong,
    doubtful
};

/** A loop closure of the map. Value type. */
struct DrawnLoop
{
    FrameId query{};
    FrameId candidate{};
    std::size_t inliers = 0;
    double weight = 0;  ///< in the optimised graph, [0, 1]; 0: it has no part in it
    LoopTruthMark truth = LoopTruthMark::unknown;
};

/** A camera that stands in the map. Value type. */
struct DrawnCamera
{
    RigidTransform map_from_camera;  ///< x right, y down, z forward; metres
    CameraModel camera;  ///< a pinhole
    cv::Mat image;  ///< 8 bit, grey or BGR; empty: the frustum alone
};

/** What the pictures of a map show. What is empty is left out, and out of the legend. Value type.
 */
struct DrawnMap
{
    std::vector<PlacedFrame> optimized;  ///< in increasing frame; at least one
    std::vector<PlacedFrame> input;  ///< before the loops, in increasing frame
    std::vector<cv::Vec3d> ground_truth;  ///< along the true way, laid over the map, metres
    std::vector<DrawnLoop> loops;  ///< those of frames without a pose are passed over
    std::vector<std::pair<FrameId, FrameId>> rejected;  ///< query and candidate; as `loops`
    std::vector<FrameId> missed;  ///< at a known place by the truth, but rejected; as `loops`
    std::vector<DrawnCamera> cameras;
};

/** A picture and from where it was taken. Value type. */
struct MapPicture
{
    cv::Mat image;  ///< 8 bit BGR
    PictureView view;
    /** From above, all that is drawn lies at this z, so that height hides nothing. */
    std::optional<double> drawn_height{};

    /** Where a position of the map is drawn, pixels. */
    cv::Point2d project(const cv::Vec3d& in_map) const;
};

/** A map as a scene: the way before and after the optimisation and in truth, loop closures coloured
 *  by inliers or weight or, where the truth about them is known, as right, wrong and doubtful with
 *  the missed ones as rings, rejected pairs faint, cameras, start and end, over a grid on the
 *  ground whose lines are labelled in metres.
 *
 *  Draws through OffscreenRenderer: without screen, GPU or window, bound to the thread that made
 *  it. Deterministic. */
class MapScene
{
 public:
    /** \throw std::invalid_argument when no frame is placed, or a pose is not finite. */
    MapScene(const DrawnMap& map, const TRenderOptions& options);
    ~MapScene();
    MapScene(const MapScene&) = delete;
    MapScene& operator=(const MapScene&) = delete;

    /** From above, nearly without perspective: a metre is as long everywhere. x is right and y up,
     *  or, where that fills the picture better, x up and y left. */
    MapPicture draw_from_above() const;

    /** From the side and above. */
    MapPicture draw_in_perspective() const;

    /** Writes the scene for MRPT's SceneViewer3D, start and end named in it. Maps that reach
     *  further than 10 km from the origin are moved by whole kilometres towards it, as are the
     *  labels of the pictures, since scenes have single precision; the pictures say by how much.
     *  \throw std::runtime_error when the file cannot be written. */
    void save(const std::string& path) const;

 private:
    std::unique_ptr<const MapContent> content_;
};

}  // namespace fild
