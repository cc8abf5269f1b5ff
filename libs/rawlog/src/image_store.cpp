// SPDX-License-Identifier: BSD-3-Clause
#include "image_store.h"

#include "fild/rawlog/image_file.h"

#include <mrpt/img/CImage.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** As CRawlog::detectImagesDirectory; none when no folder exists. */
std::optional<std::string> images_dir_beside(const fs::path& rawlog)
{
    const auto folder = rawlog.parent_path();
    const auto name = rawlog.stem().string();
    std::error_code error;
    for (const auto& each :
         {name + "_Images", name + "_images", name + "_IMAGES", std::string("Images")})
        if (fs::is_directory(folder / each, error)) return (folder / each).string();
    return std::nullopt;
}

/** Beside the rawlog, or beside the file that it is a link to. */
std::string usual_images_dir(const fs::path& rawlog)
{
    if (auto beside = images_dir_beside(rawlog)) return *beside;
    std::error_code error;
    const auto file = fs::canonical(rawlog, error);
    const auto beside_file = error ? std::nullopt : images_dir_beside(file);
    return beside_file.value_or(
        (rawlog.parent_path() / (rawlog.stem().string() + "_Images")).string());
}

bool is_there(const fs::path& path)
{
    std::error_code error;
    return fs::exists(path, error);
}

/** The name's ending with all letters changed by `change`. */
template <class Change>
fs::path with_ending(fs::path path, Change&& change)
{
    auto ending = path.extension().string();
    std::transform(ending.begin(),
                   ending.end(),
                   ending.begin(),
                   [&](unsigned char c) { return static_cast<char>(change(c)); });
    return path.replace_extension(ending);
}

/** A file of this name, or with an ending in other letters; nothing when there is none. */
std::optional<fs::path> find_file(const fs::path& path)
{
    for (const auto& each : {path,
                             with_ending(path, [](int c) { return std::tolower(c); }),
                             with_ending(path, [](int c) { return std::toupper(c); })})
        if (is_there(each)) return each;
    return std::nullopt;
}

/** The name with slashes; of an absolute path, which may be of another computer, also what it has
 *  from each folder on. A relative one is not shortened: left/1.png and right/1.png are two. */
std::vector<fs::path> ends_of(std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    std::vector<fs::path> ends{name};
    const bool is_absolute = name.rfind('/', 0) == 0 || name.find(':') == 1;  // C:
    if (!is_absolute) return ends;
    for (auto at = name.find('/'); at != std::string::npos; at = name.find('/', at + 1))
        ends.emplace_back(name.substr(at + 1));
    return ends;
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
    const auto path = fs::path(images_dir_) / name;
    if (const auto found = find_file(path)) return found->string();
    for (const auto& end : ends_of(name))
        if (const auto found = find_file(fs::path(images_dir_) / end)) return found->string();
    return path.string();
}

std::optional<cv::Mat> ImageStore::load(const mrpt::img::CImage& image) const
{
    if (image.isExternallyStored()) return read_image_file(path_of(image), max_megabytes_);
    if (image.isEmpty()) return std::nullopt;
    return image.asCvMatRef();  // since MRPT 2.0 grey or BGR, never RGB
}

namespace
{
/** Numbers that all but a thousandth at either end lie between. */
struct Levels
{
    int darkest = 0;
    int brightest = 0;
};

Levels levels_of(const cv::Mat& image)
{
    constexpr std::size_t kLeftOut = 1000;
    std::vector<std::size_t> counts(65536);
    const auto row_length =
        static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.channels());
    for (int y = 0; y < image.rows; ++y)
    {
        const auto* row = image.ptr<std::uint16_t>(y);
        for (std::size_t x = 0; x < row_length; ++x) ++counts[row[x]];
    }
    const auto left_out = static_cast<std::size_t>(image.rows) * row_length / kLeftOut;
    const auto first_beyond = [&](auto begin, auto end)
    {
        std::size_t seen = 0;
        return std::find_if(
            begin, end, [&](std::size_t count) { return (seen += count) > left_out; });
    };
    const auto low = first_beyond(counts.begin(), counts.end()) - counts.begin();
    const auto high = counts.rend() - first_beyond(counts.rbegin(), counts.rend()) - 1;
    return {static_cast<int>(low), static_cast<int>(high)};
}

cv::Mat in_8_bits(const cv::Mat& image)
{
    constexpr double kWhite = 255;
    const auto [darkest, brightest] = levels_of(image);
    const double scale = kWhite / std::max(kWhite, static_cast<double>(brightest - darkest));
    cv::Mat result;
    image.convertTo(result, CV_8U, scale, -scale * darkest);
    return result;
}
}  // namespace

std::optional<cv::Mat> as_grey_or_bgr(const cv::Mat& image)
{
    const int depth = image.depth();
    if (image.empty() || (depth != CV_8U && depth != CV_16U)) return std::nullopt;
    cv::Mat pixels = image;
    if (image.channels() == 4)
        cv::cvtColor(image, pixels, cv::COLOR_BGRA2BGR);
    else if (image.channels() != 1 && image.channels() != 3)
        return std::nullopt;
    return depth == CV_8U ? pixels : in_8_bits(pixels);
}

std::string describe_pixels(const cv::Mat& image)
{
    constexpr std::array<const char*, 8> kDepths{"8 bit",
                                                 "8 bit signed",
                                                 "16 bit",
                                                 "16 bit signed",
                                                 "32 bit signed",
                                                 "32 bit floating point",
                                                 "64 bit floating point",
                                                 "16 bit floating point"};
    const int channels = image.channels();
    return std::string(kDepths.at(static_cast<std::size_t>(image.depth()))) + ", " +
           std::to_string(channels) + (channels == 1 ? " channel" : " channels");
}

}  // namespace fild
