// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_rawlog.h"

#include "checked_image.h"
#include "fild/core/whole_file.h"
#include "fild/core/words.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/pose_conversion.h"
#include "fild/rawlog/rawlog_writer.h"
#include "fild/rawlog/robot_path_file.h"
#include "placed_images.h"
#include "robot_frame.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

void check_request(const ImageRawlogRequest& request)
{
    if (request.sensor_label == "") throw std::invalid_argument("the sensor label is empty");
    if (fs::path(request.rawlog_path).extension() != ".rawlog")
        throw std::invalid_argument("'" + request.rawlog_path + "' is not of the form NAME.rawlog");
}

void check_recording(const Recording& recording)
{
    const auto& frames = recording.frames;
    if (frames.empty()) throw std::invalid_argument("no images to write into a rawlog");
    const auto of_one_kind = [&](const RecordedFrame& frame)
    {
        return frame.right.has_value() == frames[0].right.has_value() &&
               frame.depth.has_value() == frames[0].depth.has_value();
    };
    if (!std::all_of(frames.begin(), frames.end(), of_one_kind) ||
        (frames[0].right && frames[0].depth))
        throw std::invalid_argument("a recording is either mono, stereo or with depth");
    const bool is_pair = frames[0].right || !recording.right_camera.empty();
    if (is_pair && !(recording.calibration && recording.calibration->left_from_right()))
        throw std::invalid_argument("a stereo recording needs a calibration with a baseline");
    if (!recording.right_camera.empty() && (frames[0].right || frames[0].depth))
        throw std::invalid_argument(
            "of two cameras that record by themselves a frame is one image");
    const double units = recording.depth_units_per_metre;
    if (frames[0].depth && !(units > 0 && std::isfinite(units)))
        throw std::invalid_argument("the depth units per metre must be above 0");
}

/** `NAME.rawlog` with another ending. */
fs::path beside(const fs::path& rawlog, const std::string& ending)
{
    return rawlog.parent_path() / (rawlog.stem().string() + ending);
}

/** Names for both images of a pair in one folder, different ones. */
std::pair<fs::path, fs::path> names_of_pair(const fs::path& left, const fs::path& right)
{
    if (left.filename() != right.filename()) return {left.filename(), right.filename()};
    const auto with = [&](const std::string& side)
    { return fs::path(left.stem().string() + side + left.extension().string()); };
    return {with("_left"), with("_right")};
}

mrpt::math::CMatrix_u16 to_range_image(const cv::Mat& depth)
{
    mrpt::math::CMatrix_u16 ranges(static_cast<std::size_t>(depth.rows),
                                   static_cast<std::size_t>(depth.cols));
    cv::Mat same_memory(depth.size(), depth.type(), ranges.data());
    depth.copyTo(same_memory);
    return ranges;
}

/** Turns the frames of a recording into MRPT's observations. */
class ObservationMaker
{
 public:
    ObservationMaker(const Recording& recording, std::string label, PlacedImages& images)
        : recording_(recording), label_(std::move(label)), images_(images)
    {
        const auto& calibration = recording.calibration;
        if (!calibration) return;
        camera_ = mrpt_camera_from(calibration->camera);
        right_camera_ = mrpt_camera_from(calibration->right_camera());
        left_from_right_ =
            mrpt_pose_from(calibration->left_from_right().value_or(RigidTransform()));
    }

    mrpt::obs::CObservation::Ptr make(const RecordedFrame& frame)
    {
        mrpt::obs::CObservation::Ptr observation;
        if (frame.right)
            observation = stereo(frame);
        else if (frame.depth)
            observation = range_scan(frame);
        else
            observation = mono(frame);
        observation->timestamp = mrpt::Clock::fromDouble(frame.image.seconds);
        observation->sensorLabel = label_;
        return observation;
    }

    /** An image of the right camera of two. */
    mrpt::obs::CObservation::Ptr make_right(const StampedImage& image, const std::string& label)
    {
        auto observation = mrpt::obs::CObservationImage::Create();
        observation->image = place_right(image, fs::path(image.path).filename()).image;
        observation->cameraParams = right_camera_;
        observation->cameraPose = robot_from_camera() + left_from_right_;
        observation->timestamp = mrpt::Clock::fromDouble(image.seconds);
        observation->sensorLabel = label;
        return observation;
    }

 private:
    PlacedImage place(const ImageFile& file, const fs::path& name)
    {
        auto placed = images_.place(file, name);
        if (recording_.calibration)
            check_calibrated_size(file, placed.size, recording_.calibration->camera);
        return placed;
    }

    PlacedImage place_right(const ImageFile& file, const fs::path& name)
    {
        auto placed = images_.place(file, name);
        check_calibrated_size(file, placed.size, recording_.calibration->right_camera());
        return placed;
    }

    mrpt::obs::CObservationImage::Ptr mono(const RecordedFrame& frame);
    mrpt::obs::CObservationStereoImages::Ptr stereo(const RecordedFrame& frame);
    mrpt::obs::CObservation3DRangeScan::Ptr range_scan(const RecordedFrame& frame);

    const Recording& recording_;
    std::string label_;
    PlacedImages& images_;
    mrpt::img::TCamera camera_;  ///< MRPT's default stands for "not calibrated"
    mrpt::img::TCamera right_camera_;
    mrpt::poses::CPose3D left_from_right_;
};

mrpt::obs::CObservationImage::Ptr ObservationMaker::mono(const RecordedFrame& frame)
{
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->image = place(frame.image, fs::path(frame.image.path).filename()).image;
    observation->cameraParams = camera_;
    observation->cameraPose = robot_from_camera();
    return observation;
}

mrpt::obs::CObservationStereoImages::Ptr ObservationMaker::stereo(const RecordedFrame& frame)
{
    const auto [left_name, right_name] = names_of_pair(frame.image.path, frame.right->path);
    auto left = place(frame.image, left_name);
    auto right = images_.place(*frame.right, right_name);
    if (!recording_.calibration->right)
        check_same_size(frame.image, left.size, *frame.right, right.size);
    check_calibrated_size(*frame.right, right.size, recording_.calibration->right_camera());
    auto observation = mrpt::obs::CObservationStereoImages::Create();
    observation->imageLeft = std::move(left.image);
    observation->imageRight = std::move(right.image);
    observation->hasImageRight = true;
    observation->leftCamera = camera_;
    observation->rightCamera = right_camera_;
    observation->cameraPose = mrpt::poses::CPose3DQuat(robot_from_camera());
    observation->rightCameraPose = mrpt::poses::CPose3DQuat(left_from_right_);
    return observation;
}

mrpt::obs::CObservation3DRangeScan::Ptr ObservationMaker::range_scan(const RecordedFrame& frame)
{
    auto colour = place(frame.image, fs::path(frame.image.path).filename());
    const auto depth = load_checked_depth(*frame.depth);
    check_same_size(frame.image, colour.size, *frame.depth, depth.size());
    auto observation = mrpt::obs::CObservation3DRangeScan::Create();
    observation->intensityImage = std::move(colour.image);
    observation->hasIntensityImage = true;
    observation->rangeImage = to_range_image(depth);
    observation->hasRangeImage = true;
    observation->range_is_depth = true;
    observation->rangeUnits = static_cast<float>(1 / recording_.depth_units_per_metre);
    constexpr float kLargestNumber = std::numeric_limits<std::uint16_t>::max();
    observation->maxRange = kLargestNumber * observation->rangeUnits;
    observation->cameraParams = camera_;
    observation->cameraParamsIntensity = camera_;
    observation->relativePoseIntensityWRTDepth = robot_from_camera();
    return observation;
}

/** The file of the robot's path, all of it on disk, to be committed; null when there is no path. */
std::unique_ptr<WholeFile> write_path(const fs::path& path_file,
                                      const std::vector<StampedPose>& robot_path)
{
    if (robot_path.empty()) return nullptr;
    auto file = std::make_unique<WholeFile>(path_file.string());
    write_robot_path(file->stream(), robot_path);
    if (!file->stream().flush())
        throw std::runtime_error("cannot write " + path_file.string() + "; is the disk full?");
    return file;
}

/** Of two cameras that recorded by themselves both in the order of time, the left one first. */
void write_observations(const Recording& recording,
                        const ImageRawlogRequest& request,
                        PlacedImages& images,
                        RawlogWriter& writer)
{
    const auto& right = recording.right_camera;
    const std::string usual = right.empty() ? "CAMERA1" : "CAMERA_LEFT";
    ObservationMaker maker(recording, request.sensor_label.value_or(usual), images);
    auto next = right.begin();
    const auto write_right_before = [&](double seconds)
    {
        for (; next != right.end() && next->seconds < seconds; ++next)
            writer.write(*maker.make_right(*next, "CAMERA_RIGHT"));
    };
    for (const auto& frame : recording.frames)
    {
        write_right_before(frame.image.seconds);
        writer.write(*maker.make(frame));
    }
    write_right_before(std::numeric_limits<double>::infinity());
}
}  // namespace

ImageRawlogSummary write_image_rawlog(const Recording& recording, const ImageRawlogRequest& request)
{
    check_request(request);
    check_recording(recording);
    if (request.sensor_label && !recording.right_camera.empty())
        throw std::invalid_argument(
            "two cameras get the labels CAMERA_LEFT and CAMERA_RIGHT; leave out --sensor-label");
    const auto images_dir = beside(request.rawlog_path, "_Images");
    const auto path_file = beside(request.rawlog_path, ".gt.tum");
    refuse_existing(request.rawlog_path);
    if (!request.embed) refuse_existing(images_dir);
    if (!recording.robot_path.empty()) refuse_existing(path_file);
    for (const auto& path : {fs::path(request.rawlog_path), images_dir, path_file})
        remove_unfinished_of(path.string());

    const auto robot_path = write_path(path_file, recording.robot_path);
    RawlogWriter writer(request.rawlog_path);
    PlacedImages images(request.embed ? std::nullopt : std::make_optional(images_dir));
    write_observations(recording, request, images, writer);
    images.commit();
    writer.commit();
    images.keep();
    if (robot_path) robot_path->commit();

    ImageRawlogSummary summary;
    summary.frames = recording.frames.size();
    summary.images = images.count();
    summary.depth_images = recording.frames[0].depth ? summary.frames : 0;
    if (!request.embed) summary.images_dir = images_dir.string();
    if (robot_path) summary.ground_truth_path = path_file.string();
    return summary;
}

std::string summary_text(const ImageRawlogSummary& summary)
{
    auto text = count_of(summary.frames, "frame") + " of " + count_of(summary.images, "image");
    if (summary.depth_images != 0) text += " and " + count_of(summary.depth_images, "depth image");
    text += ", " + (summary.images_dir.empty() ? "embedded" : "in " + summary.images_dir);
    if (!summary.ground_truth_path.empty()) text += "\nground truth: " + summary.ground_truth_path;
    return text;
}

}  // namespace fild
