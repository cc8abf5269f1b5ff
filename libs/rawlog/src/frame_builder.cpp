// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"

#include "calibration_mismatch.h"
#include "camera_labels.h"
#include "camera_view.h"
#include "fild/core/utf8.h"
#include "fild/rawlog/camera_conversion.h"
#include "image_store.h"
#include "metric_content.h"
#include "rectification.h"
#include "size_change.h"
#include "undistorter.h"

#include <mrpt/obs/CObservationStereoImages.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
using mrpt::obs::CObservation;

/** What a frame is to show of an observation. */
PinholeView view_of(const CObservation& observation, const CameraModel& camera)
{
    const auto* stereo = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
    if (stereo == nullptr) return straight_view(camera);
    const auto left_from_right = left_from_right_of(*stereo);
    return is_usable_baseline(left_from_right) ? rectified_left(camera, left_from_right)
                                               : straight_view(camera);
}

std::optional<CameraModel> parse_override(const std::string& words)
{
    if (words.empty()) return std::nullopt;
    return parse_camera_model(words, "camera_parameters");
}

bool are_same_pixels(const cv::Mat& a, const cv::Mat& b)
{
    return !a.empty() && a.type() == b.type() && a.size() == b.size() &&
           cv::norm(a, b, cv::NORM_INF) == 0;
}

const TInputOptions& checked(const TInputOptions& options)
{
    options.check();
    return options;
}
}  // namespace

struct FrameBuilder::State
{
    State(const TInputOptions& checked_options,
          const std::string& rawlog_path,
          FrameContent content)
        : options(checked_options),
          labels(options),
          store(options.images_dir, rawlog_path, options.max_entry_megabytes),
          override_camera(parse_override(options.camera_parameters))
    {
        if (content == FrameContent::metric)
            metric.emplace(store, options.undistort, override_camera);
    }

    struct Camera;

    /** Counts the frame; its stamp is remembered for the next one. */
    Frame begin(const CObservation& observation);
    /** Whether the frame has another size than its camera's first image: it must be changed. */
    bool has_other_size(const Frame& frame) const;
    void load_image(const CameraView& view, Frame& frame);
    /** Notes a missing image. \throw std::runtime_error where that ends the run. */
    void note_missing(const std::string& path, const Frame& frame);
    /** Gives the frame its camera and straightens its image; that of a stereo pair is rectified.
     */
    TakenImage calibrate(const CObservation& observation, const CameraView& view, Frame& frame);
    /** The camera's calibration, unless it is for another size than that of the frame's image. */
    std::optional<CameraModel> fitting_camera(const CameraView& view, const Frame& frame);

    TInputOptions options;
    CameraLabels labels;
    ImageStore store;
    std::optional<CameraModel> override_camera;
    std::optional<MetricContent> metric;  ///< when metric content is asked for
    /** What is kept from one image of a camera to the next. */
    struct Camera
    {
        Undistorter undistorter;
        std::optional<cv::Size> image_size;
        std::optional<double> previous_stamp;
        bool is_stamp_repeated = false;  ///< of the frame that is being built
        cv::Mat previous_image;  ///< as stored
    };
    std::map<std::string, Camera> cameras;  ///< by sensor label
    std::uint64_t count = 0;
    std::size_t scaled = 0;
    std::string first_missing;
    std::string first_unsupported;
    std::map<std::string, std::string> calibration_notes;  ///< by sensor label
};

Frame FrameBuilder::State::begin(const CObservation& observation)
{
    Frame frame;
    frame.id = FrameId{count++};
    frame.sensor_label = as_utf8(observation.sensorLabel);
    auto& camera = cameras[frame.sensor_label];
    camera.is_stamp_repeated = false;
    if (observation.timestamp == INVALID_TIMESTAMP)
    {
        frame.timestamp = camera.previous_stamp.value_or(0);
        return frame;
    }
    frame.timestamp = mrpt::Clock::toDouble(observation.timestamp);
    camera.is_stamp_repeated = frame.timestamp == camera.previous_stamp;
    camera.previous_stamp = frame.timestamp;
    return frame;
}

bool FrameBuilder::State::has_other_size(const Frame& frame) const
{
    return frame.image.size() != cameras.at(frame.sensor_label).image_size;
}

void FrameBuilder::State::load_image(const CameraView& view, Frame& frame)
{
    auto& camera = cameras[frame.sensor_label];
    const auto previous = std::exchange(camera.previous_image, {});
    const auto stored = store.load(view.image);
    if (!stored)
    {
        frame.defect = Rejection::missing_image;
        note_missing(store.path_of(view.image), frame);
        return;
    }
    camera.previous_image = *stored;
    const auto& first_size = camera.image_size;
    const auto image = as_grey_or_bgr(*stored);
    if (camera.is_stamp_repeated && are_same_pixels(*stored, previous))
        frame.defect = Rejection::repeated_timestamp;
    else if (!image)
    {
        frame.defect = Rejection::unsupported_image;
        if (first_unsupported.empty())
            first_unsupported =
                "frame " + std::to_string(to_index(frame.id)) + ": " + describe_pixels(*stored);
    }
    else if (first_size && image->size() != *first_size && !size_change(image->size(), *first_size))
        frame.defect = Rejection::image_size_changed;
    else
        frame.image = *image;
}

void FrameBuilder::State::note_missing(const std::string& path, const Frame& frame)
{
    const bool is_there = !path.empty() && std::filesystem::exists(path);
    if (first_missing.empty()) first_missing = path + (is_there ? ", which cannot be read" : "");
    if (options.on_missing_image == OnMissingImage::skip) return;
    const auto what = path.empty() ? "the image embedded in the rawlog is empty"
                                   : "there is no readable image " + path;
    throw std::runtime_error("frame " + std::to_string(to_index(frame.id)) + ": " + what +
                             "; set [input] images_dir to the folder of the images, or "
                             "on_missing_image=skip to go on without");
}

std::optional<CameraModel> FrameBuilder::State::fitting_camera(const CameraView& view,
                                                               const Frame& frame)
{
    const auto camera = override_camera ? override_camera : camera_model_from(view.camera);
    if (!camera) return std::nullopt;
    const auto size = frame.image.size();
    const auto& first_size = *cameras.at(frame.sensor_label).image_size;
    auto fitting = camera_for(*camera, size, first_size);
    if (!fitting && !has_other_size(frame))
        calibration_notes.emplace(frame.sensor_label,
                                  "the calibration of camera '" + frame.sensor_label + "' is for " +
                                      to_text({camera->width, camera->height}) +
                                      " pixels, its images have " + to_text(size) +
                                      ": it is not used; " + mending_advice(*camera, size));
    return fitting;
}

TakenImage FrameBuilder::State::calibrate(const CObservation& observation,
                                          const CameraView& view,
                                          Frame& frame)
{
    auto& camera = cameras.at(frame.sensor_label);
    TakenImage taken;
    taken.first_size = *camera.image_size;
    frame.camera = fitting_camera(view, frame);
    if (!frame.camera) return taken;
    taken.camera = *frame.camera;
    if (!options.undistort)
    {
        if (!has_distortion(taken.camera)) frame.camera = without_distortion(taken.camera);
        return taken;
    }
    const auto straight = view_of(observation, taken.camera);
    frame.image = camera.undistorter.undistort(frame.image, taken.camera, straight);
    frame.camera = straight.camera;
    taken.view_from_camera = straight.view_from_camera;
    return taken;
}

FrameBuilder::FrameBuilder(const TInputOptions& options,
                           const std::string& rawlog_path,
                           FrameContent content)
    : state_(std::make_unique<State>(checked(options), rawlog_path, content))
{
}

FrameBuilder::~FrameBuilder() = default;

bool FrameBuilder::accepts(const CObservation& observation)
{
    const auto label = as_utf8(observation.sensorLabel);
    if (camera_view_of(observation)) return state_->labels.accepts_camera(label);
    state_->labels.note_other(label);
    return false;
}

Frame FrameBuilder::build(const CObservation& observation)
{
    const auto view = camera_view_of(observation);
    if (!view)
        throw std::invalid_argument("FrameBuilder::build: observation '" + observation.sensorLabel +
                                    "' has no camera image");
    auto frame = state_->begin(observation);
    state_->load_image(*view, frame);
    if (frame.defect != Rejection::none) return frame;
    auto& first_size = state_->cameras[frame.sensor_label].image_size;
    if (!first_size) first_size = frame.image.size();
    const auto taken = state_->calibrate(observation, *view, frame);
    if (state_->metric)
    {
        const auto missing = state_->metric->add_to(frame, observation, taken);
        if (!missing.empty()) state_->note_missing(missing, frame);
    }
    if (state_->has_other_size(frame))
    {
        change_size(frame, *size_change(frame.image.size(), *first_size));
        ++state_->scaled;
    }
    return frame;
}

Frame FrameBuilder::skip(const CObservation& observation)
{
    auto frame = state_->begin(observation);
    auto& camera = state_->cameras[frame.sensor_label];
    camera.previous_image.release();
    auto& first_size = camera.image_size;
    const auto view = camera_view_of(observation);
    if (first_size || !view) return frame;
    const auto stored = state_->store.load(view->image);
    if (const auto image = stored ? as_grey_or_bgr(*stored) : std::nullopt)
        first_size = image->size();
    return frame;
}

FrameId FrameBuilder::next_id() const
{
    return FrameId{state_->count};
}

std::size_t FrameBuilder::scaled_frames() const
{
    return state_->scaled;
}

std::string FrameBuilder::first_missing_image() const
{
    return state_->first_missing;
}

std::string FrameBuilder::first_unsupported_image() const
{
    return state_->first_unsupported;
}

std::vector<std::string> FrameBuilder::calibration_notes() const
{
    std::vector<std::string> notes;
    for (const auto& [label, note] : state_->calibration_notes) notes.push_back(note);
    if (!state_->metric) return notes;
    for (const auto& [label, note] : state_->metric->calibration_notes()) notes.push_back(note);
    return notes;
}

std::vector<std::string> FrameBuilder::ignored_camera_labels() const
{
    return state_->labels.ignored();
}

std::string FrameBuilder::describe_labels() const
{
    return state_->labels.describe();
}

}  // namespace fild
