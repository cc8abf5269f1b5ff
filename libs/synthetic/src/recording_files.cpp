// SPDX-License-Identifier: BSD-3-Clause
#include "recording_files.h"

#include <opencv2/imgcodecs.hpp>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;
}  // namespace

/** Where everything goes. */
struct RecordingFiles::Names
{
    Names(const fs::path& rawlog_path, bool embed) : rawlog(rawlog_path)
    {
        if (rawlog.extension() != ".rawlog")
            throw std::invalid_argument("'" + rawlog.string() + "' is not of the form NAME.rawlog");
        const auto beside = [&](const char* ending)
        { return rawlog.parent_path() / (rawlog.stem().string() + ending); };
        poses = beside(".gt.tum");
        loops = beside(".loops.txt");
        images = beside("_Images");  // where MRPT looks for them
        for (const auto& path : {rawlog, poses, loops}) refuse_existing(path);
        if (embed)
            images.clear();
        else
            refuse_existing(images);
        for (const auto& path : {rawlog, poses, loops, beside("_Images")})
            remove_unfinished_of(path.string());
    }

    fs::path rawlog;
    fs::path poses;
    fs::path loops;
    fs::path images;  ///< empty: embedded
};

RecordingFiles::RecordingFiles(const std::string& rawlog_path, bool embed)
    : RecordingFiles(Names(rawlog_path, embed))
{
}

RecordingFiles::RecordingFiles(const Names& names)
    : paths_{names.rawlog.string(), names.poses.string(), names.loops.string()},
      rawlog_(names.rawlog.string()),
      poses_(names.poses.string()),
      loops_(names.loops.string())
{
    if (names.images.empty()) return;
    images_.emplace(names.images);
    paths_.push_back(names.images.string());
}

RecordingFiles::~RecordingFiles()
{
    std::error_code ignored;  // nothing can be done about a file that will not go
    for (const auto& path : to_remove_) fs::remove(path, ignored);
}

mrpt::img::CImage RecordingFiles::add_image(const std::string& name, const cv::Mat& image) const
{
    if (!images_) return {image, mrpt::img::SHALLOW_COPY};
    std::vector<uchar> bytes;
    if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality}))
        throw std::runtime_error("cannot compress the image " + name + " as JPEG");
    const auto path = images_->location() / name;
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + path.string() +
                                 " to its end: is the disk full?");
    mrpt::img::CImage reference;
    reference.setExternalStorage(name);
    return reference;
}

std::vector<std::string> RecordingFiles::commit()
{
    if (images_) images_->commit();
    poses_.commit();
    to_remove_.emplace_back(paths_[1]);
    loops_.commit();
    to_remove_.emplace_back(paths_[2]);
    rawlog_.commit();
    to_remove_.clear();
    if (images_) images_->keep();
    return paths_;
}

}  // namespace fild
