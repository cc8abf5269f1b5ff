// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"
#include "image_store.h"
#include "undistorter.h"

#include <map>
#include <optional>
#include <string>

namespace mrpt::obs
{
class CObservation;
class CObservation3DRangeScan;
class CObservationStereoImages;
}  // namespace mrpt::obs

namespace fild
{
/** An image of a frame before it was straightened. Value type. */
struct TakenImage
{
    CameraModel camera;  ///< not set when the frame has no camera
    cv::Matx33d view_from_camera = cv::Matx33d::eye();  ///< to the axes of the frame's camera
    /** Of this camera's first image: a calibration for it serves images of other sizes with the
     *  same aspect ratio. */
    cv::Size first_size;
};

/** The pose of the right camera of a stereo pair in the left one. */
RigidTransform left_from_right_of(const mrpt::obs::CObservationStereoImages& stereo);

/** Gives frames what metric poses need: the right image or the depth image, and the camera's pose
 *  on the robot. Not thread-safe: one caller at a time. */
class MetricContent
{
 public:
    /** \param store  outlives this. \param override_camera  instead of every camera's own. */
    MetricContent(const ImageStore& store,
                  bool undistort,
                  const std::optional<CameraModel>& override_camera);

    /** \param frame  of `observation`, with image and camera. Sets depth_defect when there is no
     *  depth to be had.
     *  \param taken  how the image was taken.
     *  \return path of a right or depth image that is stored outside the rawlog and cannot be
     *  read; empty when there is none such.
     *  A right camera that is calibrated for another image size is not_calibrated, and noted unless
     *  the frame is scaled. */
    std::string add_to(Frame& frame,
                       const mrpt::obs::CObservation& observation,
                       const TakenImage& taken);

    /** For the user, by sensor label: right cameras that are calibrated for another image size. */
    const std::map<std::string, std::string>& calibration_notes() const
    {
        return calibration_notes_;
    }

 private:
    std::string add_right(Frame& frame,
                          const mrpt::obs::CObservationStereoImages& stereo,
                          const TakenImage& left);
    std::string add_depth(Frame& frame,
                          const mrpt::obs::CObservation3DRangeScan& scan,
                          cv::Size first_size);
    cv::Mat depth_on_image(const Frame& frame,
                           const mrpt::obs::CObservation3DRangeScan& scan,
                           const cv::Mat& ranges,
                           cv::Size first_size);

    void note_right_calibration(const Frame& frame, const CameraModel& camera, cv::Size images);

    const ImageStore& store_;
    bool undistort_;
    std::optional<CameraModel> override_camera_;
    std::map<std::string, Undistorter> undistorters_;  ///< of right or depth images, by label
    std::map<std::string, std::string> calibration_notes_;
};

}  // namespace fild
