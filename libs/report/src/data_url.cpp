// SPDX-License-Identifier: BSD-3-Clause
#include "data_url.h"

#include "fild/core/decoder_messages.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>
#include <iterator>
#include <openssl/evp.h>
#include <stdexcept>
#include <vector>

namespace fild
{
namespace
{
std::string data_url(const std::string& type, const std::vector<unsigned char>& bytes)
{
    std::string base64((bytes.size() + 2) / 3 * 4 + 1, '\0');  // and the zero that OpenSSL appends
    const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()),
                                       bytes.data(),
                                       static_cast<int>(bytes.size()));
    base64.resize(static_cast<std::size_t>(length));
    return "data:image/" + type + ";base64," + base64;
}

std::vector<unsigned char> bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file || bytes.empty()) throw std::runtime_error("cannot read " + path);
    return bytes;
}

cv::Mat read_picture(const std::string& path, int mode)
{
    const WithoutDecoderMessages quiet;
    return cv::imread(path, mode);
}
}  // namespace

std::string data_url_of_png(const std::string& path)
{
    return data_url("png", bytes_of(path));
}

std::string data_url_of_picture(const std::string& path, int max_width_px)
{
    constexpr double kWideEnough = 0.7;  // of max_width_px; half a picture is read in no time
    auto picture = read_picture(path, cv::IMREAD_REDUCED_COLOR_2);
    if (picture.cols < kWideEnough * max_width_px) picture = read_picture(path, cv::IMREAD_COLOR);
    if (picture.empty()) throw std::runtime_error("cannot read the picture " + path);
    if (picture.cols > max_width_px)
    {
        const double scale = static_cast<double>(max_width_px) / picture.cols;
        cv::resize(picture, picture, {}, scale, scale, cv::INTER_AREA);
    }
    std::vector<unsigned char> jpeg;
    constexpr int kQuality = 82;
    if (!cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality}))
        throw std::runtime_error("cannot encode the picture " + path);
    return data_url("jpeg", jpeg);
}

}  // namespace fild
