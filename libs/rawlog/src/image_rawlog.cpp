// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_rawlog.h"

#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/image_file.h"
#include "fild/rawlog/rawlog_writer.h"
#include "fild/rawlog/whole_folder.h"
#include "image_store.h"

#include <mrpt/obs/CObservationImage.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

void check_request(const std::vector<StampedImage>& images, const ImageRawlogRequest& request)
{
    if (images.empty()) throw std::invalid_argument("no images to write into a rawlog");
    if (request.sensor_label.empty()) throw std::invalid_argument("the sensor label is empty");
    if (fs::path(request.rawlog_path).extension() != ".rawlog")
        throw std::invalid_argument("'" + request.rawlog_path + "' is not of the form NAME.rawlog");
}

void refuse_existing(const fs::path& path)
{
    if (fs::exists(fs::symlink_status(path)))
        throw std::runtime_error(path.string() +
                                 " exists already; remove it or choose another output");
}

fs::path images_dir_of(const fs::path& rawlog)
{
    return rawlog.parent_path() / (rawlog.stem().string() + "_Images");
}

/** The pixels of a listed image. \throw std::runtime_error when they cannot be used. */
cv::Mat load_checked(const StampedImage& listed, const std::optional<CameraModel>& camera)
{
    // A path is its own origin when the images come from a folder.
    const auto where =
        listed.path + (listed.origin == listed.path ? "" : " (" + listed.origin + ")");
    const auto stored = read_image_file(listed.path);
    std::error_code error;  // exists() itself fails at a loop of links
    if (!stored)
        throw std::runtime_error(where +
                                 (fs::exists(listed.path, error)
                                      ? " is no image that can be read to its end; repair it"
                                      : " does not exist; correct the path") +
                                 " or leave it out");
    auto image = as_grey_or_bgr(*stored);
    if (!image)
        throw std::runtime_error(where + " has neither 8-bit grey nor 8-bit colour pixels; " +
                                 "convert it");
    if (camera && (image->cols != camera->width || image->rows != camera->height))
        throw std::runtime_error("the calibration is for " + std::to_string(camera->width) + "x" +
                                 std::to_string(camera->height) + " pixels, " + where + " has " +
                                 std::to_string(image->cols) + "x" + std::to_string(image->rows) +
                                 "; correct the calibration or leave it out");
    return *image;
}

/** The images of a rawlog as files in a folder, each distinct file once. */
class ImageFolder
{
 public:
    ImageFolder(const fs::path& path, const std::optional<CameraModel>& camera)
        : folder_(path), camera_(camera)
    {
    }

    /** Puts the image there unless it is there already. \return its name in the folder. */
    std::string add(const StampedImage& listed);
    WholeFolder& folder() { return folder_; }

 private:
    std::string unused_name(const fs::path& wanted) const;
    void put(const fs::path& source, const fs::path& target) const;

    WholeFolder folder_;
    std::optional<CameraModel> camera_;
    std::map<std::string, std::string> name_of_source_;
    std::set<std::string> used_names_;
};

std::string ImageFolder::add(const StampedImage& listed)
{
    std::error_code error;  // a path that leads nowhere is told by load_checked
    const auto source = fs::canonical(listed.path, error);
    const auto known = name_of_source_.find(source.string());
    if (!error && known != name_of_source_.end()) return known->second;
    load_checked(listed, camera_);
    auto name = unused_name(fs::path(listed.path).filename());
    put(source, folder_.location() / name);
    used_names_.insert(name);
    name_of_source_.emplace(source.string(), name);
    return name;
}

std::string ImageFolder::unused_name(const fs::path& wanted) const
{
    auto name = wanted.string();
    for (int number = 2; used_names_.count(name) != 0; ++number)
        name = wanted.stem().string() + "_" + std::to_string(number) + wanted.extension().string();
    return name;
}

void ImageFolder::put(const fs::path& source, const fs::path& target) const
{
    std::error_code error;
    fs::create_hard_link(source, target, error);
    if (!error) return;
    error.clear();
    fs::copy_file(source, target, error);
    if (error)
        throw std::runtime_error("cannot copy " + source.string() +
                                 " beside the rawlog: " + error.message() + "; is the disk full?");
}

mrpt::obs::CObservationImage observation_of(const StampedImage& listed,
                                            const ImageRawlogRequest& request)
{
    mrpt::obs::CObservationImage observation;
    observation.timestamp = mrpt::Clock::fromDouble(listed.seconds);
    observation.sensorLabel = request.sensor_label;
    if (request.camera) observation.cameraParams = mrpt_camera_from(*request.camera);
    return observation;
}

ImageRawlogSummary write_embedded(const std::vector<StampedImage>& images,
                                  const ImageRawlogRequest& request)
{
    RawlogWriter writer(request.rawlog_path);
    std::set<std::string> distinct;
    for (const auto& listed : images)
    {
        auto observation = observation_of(listed, request);
        const auto pixels = load_checked(listed, request.camera);
        observation.image = mrpt::img::CImage(pixels, mrpt::img::SHALLOW_COPY);
        writer.write(observation);
        distinct.insert(fs::canonical(listed.path).string());
    }
    writer.commit();
    return {images.size(), distinct.size(), ""};
}

ImageRawlogSummary write_with_folder(const std::vector<StampedImage>& images,
                                     const ImageRawlogRequest& request)
{
    const auto images_dir = images_dir_of(request.rawlog_path);
    refuse_existing(images_dir);
    RawlogWriter writer(request.rawlog_path);
    ImageFolder folder(images_dir, request.camera);
    std::set<std::string> distinct;
    for (const auto& listed : images)
    {
        auto observation = observation_of(listed, request);
        const auto name = folder.add(listed);
        observation.image.setExternalStorage(name);
        writer.write(observation);
        distinct.insert(name);
    }
    folder.folder().commit();
    writer.commit();
    folder.folder().keep();
    return {images.size(), distinct.size(), images_dir.string()};
}
}  // namespace

ImageRawlogSummary write_image_rawlog(const std::vector<StampedImage>& images,
                                      const ImageRawlogRequest& request)
{
    check_request(images, request);
    refuse_existing(request.rawlog_path);
    return request.embed ? write_embedded(images, request) : write_with_folder(images, request);
}

}  // namespace fild
