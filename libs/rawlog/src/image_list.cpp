// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_list.h"

#include "fild/core/parse_number.h"
#include "fild/core/words.h"
#include "folder_entries.h"
#include "text_lines.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** A rawlog counts tenths of microseconds; today's dates as double are good to a quarter of one. */
constexpr double kMinStepSeconds = 1e-6;
constexpr double kEndOfTimeSeconds = 1e10;  // the year 2286

/** A time and the place it was read from. */
struct Stamp
{
    double seconds = 0;
    std::string origin;
};

ListedImage parse_list_line(const TextLine& line, const fs::path& folder)
{
    ListedImage image;
    image.origin = line.origin;
    auto name = line.text;
    if (const auto blank = name.find_last_of(" \t"); blank != std::string::npos)
    {
        image.seconds = parse_number<double>(name.substr(blank + 1));
        if (image.seconds) name = trim(name.substr(0, blank));
    }
    image.path = (folder / name).string();
    return image;
}

std::vector<Stamp> stamps_of_list(const std::vector<ListedImage>& images)
{
    std::vector<Stamp> stamps;
    for (const auto& image : images)
        if (image.seconds) stamps.push_back({*image.seconds, image.origin});
    return stamps;
}

std::vector<Stamp> stamps_of_file(const std::string& path)
{
    std::vector<Stamp> stamps;
    for (const auto& line : read_text_lines(path))
    {
        const auto seconds = parse_number<double>(line.text);
        if (!seconds)
            throw std::runtime_error(line.origin + ": '" + line.text +
                                     "' is not a number; one number of seconds a line is expected");
        stamps.push_back({*seconds, line.origin});
    }
    return stamps;
}

std::vector<Stamp> stamps_at_rate(double rate_hz, const std::vector<ListedImage>& images)
{
    if (!(rate_hz > 0 && rate_hz <= 1 / kMinStepSeconds))
        throw std::invalid_argument("the rate must be above 0 and at most 1e6 Hz");
    std::vector<Stamp> stamps;
    stamps.reserve(images.size());
    for (const auto& image : images)
        stamps.push_back({static_cast<double>(stamps.size()) / rate_hz, image.origin});
    return stamps;
}

void check_one_source(bool list_has_times, const TimestampSource& source)
{
    const int sources =
        int(list_has_times) + int(!source.file.empty()) + int(source.rate_hz.has_value());
    if (sources == 1) return;
    const std::string ways =
        "the second column of the list, --timestamps FILE or --rate HZ; give exactly one";
    throw std::invalid_argument(
        (sources == 0 ? "no time stamps: they come from " : "several sources of time stamps: ") +
        ways);
}

void check_stamps(const std::vector<Stamp>& stamps)
{
    const Stamp* previous = nullptr;
    for (const auto& stamp : stamps)
    {
        if (!(stamp.seconds >= 0 && stamp.seconds < kEndOfTimeSeconds))
            throw std::runtime_error(stamp.origin +
                                     ": the time is outside [0, 1e10) seconds; is it in another "
                                     "unit than seconds?");
        if (previous != nullptr && !(stamp.seconds - previous->seconds > 0.5 * kMinStepSeconds))
            throw std::runtime_error(stamp.origin + ": the time does not grow by a microsecond " +
                                     "over the one of " + previous->origin +
                                     "; sort the images by time and drop repeated ones");
        previous = &stamp;
    }
}
}  // namespace

std::vector<ListedImage> list_image_folder(const std::string& folder)
{
    const auto paths = image_paths_in(folder);
    if (paths.empty())
        throw std::runtime_error(
            "no image in folder " + folder + example_in(folder) +
            "; it must hold .png .jpg .jpeg .pgm .ppm .pnm .bmp .tif or .tiff files");
    std::vector<ListedImage> images;
    images.reserve(paths.size());
    for (const auto& path : paths) images.push_back({{path, path}, std::nullopt});
    return images;
}

std::vector<ListedImage> read_image_list(const std::string& path)
{
    std::vector<ListedImage> images;
    for (const auto& line : read_text_lines(path))
    {
        images.push_back(parse_list_line(line, fs::path(path).parent_path()));
        if (images.back().seconds.has_value() != images.front().seconds.has_value())
            throw std::runtime_error(line.origin + " and " + images.front().origin +
                                     ": one has a time behind the file name, the other has not; "
                                     "give it in all lines or in none");
    }
    if (images.empty())
        throw std::runtime_error("no image in list " + path + "; write one file name a line");
    return images;
}

std::vector<StampedImage> stamp_images(const std::vector<ListedImage>& images,
                                       const TimestampSource& source)
{
    auto stamps = stamps_of_list(images);
    check_one_source(!stamps.empty(), source);
    if (!source.file.empty()) stamps = stamps_of_file(source.file);
    if (source.rate_hz) stamps = stamps_at_rate(*source.rate_hz, images);
    if (stamps.size() != images.size())
        throw std::runtime_error(count_of(stamps.size(), "time") + " in " + source.file + " for " +
                                 count_of(images.size(), "image") + "; there must be one for each");
    check_stamps(stamps);
    std::vector<StampedImage> stamped;
    stamped.reserve(images.size());
    for (std::size_t i = 0; i < images.size(); ++i)
        stamped.push_back({images[i], stamps[i].seconds});
    return stamped;
}

}  // namespace fild
