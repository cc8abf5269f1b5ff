// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_file.h"

#include "fild/core/decoder_messages.h"

#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace fild
{
namespace
{
std::vector<char> read_bytes(const std::string& path, std::size_t max_bytes)
{
    std::error_code error;  // a folder opens as a stream, and has no size
    if (!std::filesystem::is_regular_file(path, error)) return {};
    const auto size = std::filesystem::file_size(path, error);
    if (error || size > max_bytes) return {};
    std::vector<char> bytes(size);
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/** A number of `count` bytes, the highest first; 0 behind the end. */
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t count)
{
    std::size_t number = 0;
    if (at + count > bytes.size()) return number;
    for (std::size_t i = at; i < at + count; ++i)
        number = number << 8U | static_cast<unsigned char>(bytes[i]);
    return number;
}

/** What the markers of a JPEG say of it. */
struct JpegOutline
{
    bool is_cut_off = true;
    std::size_t pixel_bytes = 0;
};

/** Begins a JPEG's size, channels and kind of coding: SOF0 to SOF15. */
bool is_frame_header(unsigned char marker)
{
    const bool is_other = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    return marker >= 0xC0 && marker <= 0xCF && !is_other;
}

/** libjpeg fills what is missing with grey and only prints a warning. So the markers are followed
 * to the one that ends the image. What stands behind it, as in photos with a film or with data of
 * the phone's, may be anything. */
JpegOutline outline_of_jpeg(std::string_view bytes)
{
    constexpr unsigned char kEndOfImage = 0xD9;
    JpegOutline outline;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    for (std::size_t at = bytes.find('\xFF', 2); at != std::string_view::npos;
         at = bytes.find('\xFF', at))
    {
        at = bytes.find_first_not_of('\xFF', at);
        if (at == std::string_view::npos) return outline;
        const auto marker = byte(at++);
        outline.is_cut_off = marker != kEndOfImage;
        if (!outline.is_cut_off) return outline;
        const bool is_restart = marker >= 0xD0 && marker <= 0xD7;
        const bool stands_alone = marker <= 0x01 || is_restart;  // 0: no marker but data
        if (stands_alone) continue;
        if (at + 2 > bytes.size()) return outline;
        if (is_frame_header(marker))  // length, bits, height, width, channels
            outline.pixel_bytes = number_at(bytes, at + 3, 2) * number_at(bytes, at + 5, 2) *
                                  number_at(bytes, at + 7, 1);
        at += number_at(bytes, at, 2);  // the segment, thumbnails included
    }
    return outline;
}

/** By the header of a PNG: width, height, bits, kind of colour. OpenCV gives each pixel as many
 *  channels as the largest kind has. */
std::size_t pixel_bytes_of_png(std::string_view bytes)
{
    constexpr std::size_t kMostChannels = 4;
    return number_at(bytes, 16, 4) * number_at(bytes, 20, 4) * kMostChannels *
           (number_at(bytes, 24, 1) > 8 ? 2 : 1);
}

bool is_sound(std::string_view bytes, std::size_t max_bytes)
{
    if (bytes.substr(0, 2) == "\xFF\xD8")
    {
        const auto outline = outline_of_jpeg(bytes);
        return !outline.is_cut_off && outline.pixel_bytes <= max_bytes;
    }
    if (bytes.substr(0, 4) == "\x89PNG") return pixel_bytes_of_png(bytes) <= max_bytes;
    return true;
}
}  // namespace

std::optional<cv::Mat> read_image_file(const std::string& path, int max_megabytes)
{
    const auto max_bytes = static_cast<std::size_t>(max_megabytes) << 20U;
    const auto bytes = read_bytes(path, max_bytes);
    if (bytes.empty() || !is_sound({bytes.data(), bytes.size()}, max_bytes)) return std::nullopt;
    const WithoutDecoderMessages quiet;
    try
    {
        auto image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
        if (image.empty()) return std::nullopt;
        return image;
    }
    catch (const cv::Exception&)  // a header that asks for more pixels than OpenCV allows
    {
        return std::nullopt;
    }
}

}  // namespace fild
