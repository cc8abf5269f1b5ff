// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_file.h"

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
std::vector<char> read_bytes(const std::string& path)
{
    std::error_code error;  // a folder opens as a stream, and has no size
    if (!std::filesystem::is_regular_file(path, error)) return {};
    std::vector<char> bytes(std::filesystem::file_size(path, error));
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/** libjpeg fills what is missing with grey and only prints a warning. So the markers are followed
 * to the one that ends the image. What stands behind it, as in photos with a film or with data of
 * the phone's, may be anything. */
bool is_cut_off_jpeg(std::string_view bytes)
{
    constexpr unsigned char kEndOfImage = 0xD9;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    if (bytes.substr(0, 2) != "\xFF\xD8") return false;
    for (std::size_t at = bytes.find('\xFF', 2); at != std::string_view::npos;
         at = bytes.find('\xFF', at))
    {
        at = bytes.find_first_not_of('\xFF', at);
        if (at == std::string_view::npos) return true;
        const auto marker = byte(at++);
        if (marker == kEndOfImage) return false;
        const bool is_restart = marker >= 0xD0 && marker <= 0xD7;
        const bool stands_alone = marker <= 0x01 || is_restart;  // 0: no marker but data
        if (stands_alone) continue;
        if (at + 2 > bytes.size()) return true;
        at += std::size_t{byte(at)} << 8U | byte(at + 1);  // the segment, thumbnails included
    }
    return true;
}
}  // namespace

std::optional<cv::Mat> read_image_file(const std::string& path)
{
    const auto bytes = read_bytes(path);
    if (bytes.empty() || is_cut_off_jpeg({bytes.data(), bytes.size()})) return std::nullopt;
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
