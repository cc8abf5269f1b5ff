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

/** libjpeg fills what is missing with grey and only prints a warning. Inside compressed data FF D9
 *  cannot stand, so a whole file has one behind its last start of scan (FF DA). */
bool is_cut_off_jpeg(std::string_view bytes)
{
    if (bytes.substr(0, 2) != "\xFF\xD8") return false;
    const auto end_of_image = bytes.rfind("\xFF\xD9");
    const auto start_of_scan = bytes.rfind("\xFF\xDA");
    return end_of_image == std::string_view::npos || start_of_scan == std::string_view::npos ||
           end_of_image < start_of_scan;
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
