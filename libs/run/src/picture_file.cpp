// SPDX-License-Identifier: BSD-3-Clause
#include "picture_file.h"

#include "fild/core/whole_file.h"

#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <vector>

namespace fild
{
void write_picture(const std::string& path, const cv::Mat& picture)
{
    constexpr int kQuality = 92;  // of JPEG: letters and thin lines stay sharp
    std::vector<unsigned char> bytes;
    cv::imencode(std::filesystem::path(path).extension().string(),
                 picture,
                 bytes,
                 {cv::IMWRITE_JPEG_QUALITY, kQuality});
    WholeFile file(path);
    file.stream().write(reinterpret_cast<const char*>(bytes.data()),
                        static_cast<std::streamsize>(bytes.size()));
    file.commit();
}

}  // namespace fild
