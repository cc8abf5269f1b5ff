// SPDX-License-Identifier: BSD-3-Clause
#include "image_store.h"

#include "fild/rawlog/image_file.h"

#include <mrpt/img/CImage.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** As CRawlog::detectImagesDirectory, whose answer lacks the '/' when no folder exists. */
std::string usual_images_dir(const fs::path& rawlog)
{
    const auto folder = rawlog.parent_path();
    const auto name = rawlog.stem().string();
    for (const auto& candidate : {name + "_Images", name + "_images", name + "_IMAGES"})
        if (fs::is_directory(folder / candidate)) return (folder / candidate).string();
    if (fs::is_directory(folder / "Images")) return (folder / "Images").string();
    return (folder / (name + "_Images")).string();
}
}  // namespace

ImageStore::ImageStore(const std::string& images_dir,
                       const std::string& rawlog_path,
                       int max_megabytes)
    : images_dir_(images_dir.empty() ? usual_images_dir(rawlog_path) : images_dir),
      max_megabytes_(max_megabytes)
{
}

std::string ImageStore::path_of(const mrpt::img::CImage& image) const
{
    if (!image.isExternallyStored()) return "";
    return path_of_file(image.getExternalStorageFile());
}

std::string ImageStore::path_of_file(const std::string& name) const
{
    return (fs::path(images_dir_) / name).string();
}

std::optional<cv::Mat> ImageStore::load(const mrpt::img::CImage& image) const
{
    if (image.isExternallyStored()) return read_image_file(path_of(image), max_megabytes_);
    if (image.isEmpty()) return std::nullopt;
    return image.asCvMatRef();  // since MRPT 2.0 grey or BGR, never RGB
}

std::optional<cv::Mat> as_grey_or_bgr(const cv::Mat& image)
{
    if (image.type() == CV_8UC1 || image.type() == CV_8UC3) return image;
    if (image.type() != CV_8UC4) return std::nullopt;
    cv::Mat colour;
    cv::cvtColor(image, colour, cv::COLOR_BGRA2BGR);
    return colour;
}

}  // namespace fild
