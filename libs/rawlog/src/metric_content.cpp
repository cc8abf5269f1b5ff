// SPDX-License-Identifier: BSD-3-Clause
#include "metric_content.h"

#include "calibration_mismatch.h"
#include "depth_registration.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/pose_conversion.h"
#include "paired_images.h"
#include "range_image.h"
#include "rectification.h"
#include "robot_frame.h"
#include "size_change.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <limits>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
using namespace mrpt::obs;

RigidTransform robot_from_camera_of(const CObservation& observation)
{
    mrpt::poses::CPose3D robot_from_sensor;
    observation.getSensorPose(robot_from_sensor);
    if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation))
        return rigid_transform_from(robot_from_sensor + scan->relativePoseIntensityWRTDepth);
    return rigid_transform_from(robot_from_sensor);
}

/** How much later the right image was taken. */
double seconds_later_in(const CObservationStereoImages& stereo)
{
    const auto* paired = dynamic_cast<const CPairedImages*>(&stereo);
    return paired == nullptr ? 0 : paired->right_seconds_later;
}

/** True when each number of the range image belongs to the pixel at the same place. */
bool is_registered(const CObservation3DRangeScan& scan)
{
    const auto& a = scan.cameraParams;
    const auto& b = scan.cameraParamsIntensity;
    return scan.doDepthAndIntensityCamerasCoincide() && a.intrinsicParams == b.intrinsicParams &&
           a.distortion == b.distortion && a.dist == b.dist && a.ncols == b.ncols &&
           a.nrows == b.nrows;
}

/** Zeros, which stand for no reading in MRPT, become NaN. */
cv::Mat with_nan(cv::Mat depth)
{
    depth.setTo(std::numeric_limits<float>::quiet_NaN(), ~(depth > 0));
    return depth;
}
}  // namespace

RigidTransform left_from_right_of(const CObservationStereoImages& stereo)
{
    return rigid_transform_from(mrpt::poses::CPose3D(stereo.rightCameraPose));
}

MetricContent::MetricContent(const ImageStore& store,
                             bool undistort,
                             const std::optional<CameraModel>& override_camera)
    : store_(store), undistort_(undistort), override_camera_(override_camera)
{
}

std::string MetricContent::add_to(Frame& frame,
                                  const CObservation& observation,
                                  const TakenImage& taken)
{
    frame.robot_from_camera =
        robot_from_camera_of(observation) * RigidTransform{taken.view_from_camera.t(), {}};
    const auto* stereo = dynamic_cast<const CObservationStereoImages*>(&observation);
    const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
    if (!frame.camera)
        frame.depth_defect = DepthDefect::not_calibrated;
    else if (has_distortion(*frame.camera))
        frame.depth_defect = DepthDefect::distorted;
    else if (stereo != nullptr)
        return add_right(frame, *stereo, taken);
    else if (scan != nullptr)
        return add_depth(frame, *scan, taken.first_size);
    else
        frame.depth_defect = DepthDefect::mono;
    return "";
}

std::string MetricContent::add_right(Frame& frame,
                                     const CObservationStereoImages& stereo,
                                     const TakenImage& left)
{
    const auto camera = override_camera_ ? override_camera_ : camera_model_from(stereo.rightCamera);
    const auto left_from_right = left_from_right_of(stereo);
    const auto stored = stereo.hasImageRight ? store_.load(stereo.imageRight) : std::nullopt;
    const auto image = stored ? as_grey_or_bgr(*stored) : std::nullopt;
    if (!camera)
        frame.depth_defect = DepthDefect::not_calibrated;
    else if (has_distortion(*camera) && !undistort_)
        frame.depth_defect = DepthDefect::distorted;
    else if (!is_usable_baseline(left_from_right))
        frame.depth_defect = DepthDefect::unusable_baseline;
    else if (!image)
        frame.depth_defect = DepthDefect::missing_right_image;
    if (frame.depth_defect != DepthDefect::none)
        return stored || !stereo.hasImageRight ? "" : store_.path_of(stereo.imageRight);
    const bool is_scaled = frame.image.size() != left.first_size;
    const auto fitting =
        camera_for(*camera, image->size(), is_scaled ? left.first_size : image->size());
    if (!fitting)
    {
        frame.depth_defect = DepthDefect::not_calibrated;
        if (!is_scaled) note_right_calibration(frame, *camera, image->size());
        return "";
    }
    const auto views = undistort_ ? rectify(left.camera, *fitting, left_from_right)
                                  : Rectification{{}, straight_view(*fitting), left_from_right};
    frame.right =
        RightView{undistorters_[frame.sensor_label].undistort(*image, *fitting, views.right),
                  views.right.camera,
                  views.left_from_right,
                  seconds_later_in(stereo)};
    return "";
}

void MetricContent::note_right_calibration(const Frame& frame,
                                           const CameraModel& camera,
                                           cv::Size images)
{
    // [input] camera_parameters is for both cameras of a pair.
    const bool are_equal = images == frame.image.size();
    calibration_notes_.emplace(
        frame.sensor_label,
        "the calibration of the right camera of '" + frame.sensor_label + "' is for " +
            to_text({camera.width, camera.height}) + " pixels, its images have " + to_text(images) +
            ": its pairs give no depth; " +
            (are_equal ? mending_advice(camera, images) : "calibrate it for that size"));
}

std::string MetricContent::add_depth(Frame& frame,
                                     const CObservation3DRangeScan& scan,
                                     cv::Size first_size)
{
    auto path = scan.hasRangeImage && scan.rangeImage_isExternallyStored()
                    ? store_.path_of_file(scan.rangeImage_getExternalStorageFile(""))
                    : "";
    const auto ranges = ranges_of(scan, path);
    if (!ranges.empty())
    {
        frame.depth = depth_on_image(frame, scan, ranges, first_size);
        if (frame.depth.empty())
            frame.depth_defect = DepthDefect::not_calibrated;
        else if (cv::countNonZero(frame.depth > 0) == 0)
        {
            frame.depth.release();
            frame.depth_defect = DepthDefect::empty_depth_image;
        }
        return "";
    }
    frame.depth_defect = DepthDefect::missing_depth_image;
    return path;
}

cv::Mat MetricContent::depth_on_image(const Frame& frame,
                                      const CObservation3DRangeScan& scan,
                                      const cv::Mat& ranges,
                                      cv::Size first_size)
{
    const bool registered = is_registered(scan) && ranges.size() == frame.image.size();
    auto camera = camera_model_from(scan.cameraParams);
    if (registered && override_camera_) camera = override_camera_;
    if (camera)
        camera = camera_for(*camera, ranges.size(), registered ? first_size : ranges.size());
    if (!camera) return {};
    const auto view = straight_view(*camera);
    auto straight =
        undistorters_[frame.sensor_label].undistort(ranges, *camera, view, cv::INTER_NEAREST);
    const auto& pinhole = view.camera;
    if (!scan.range_is_depth) straight = depth_from_ranges(straight, pinhole);
    if (registered) return with_nan(straight);
    const auto image_from_depth =
        rigid_transform_from(scan.relativePoseIntensityWRTDepth).inverse() *
        rigid_transform_from(robot_from_camera());  // the range image looks along its sensor's x
    return with_nan(registered_depth(straight, pinhole, *frame.camera, image_from_depth));
}

}  // namespace fild
