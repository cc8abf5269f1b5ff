// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/similarity_matrix.h"

#include "fild/core/whole_file.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fild
{
namespace
{
/** The mean of those that are not empty. */
std::vector<double> mean_of(const std::vector<GlobalDescriptor>& descriptors)
{
    std::vector<double> mean;
    double count = 0;
    for (const auto& descriptor : descriptors)
    {
        if (descriptor.empty()) continue;
        mean.resize(descriptor.size());
        std::transform(mean.begin(), mean.end(), descriptor.begin(), mean.begin(), std::plus<>());
        ++count;
    }
    for (auto& value : mean) value /= count;
    return mean;
}

double product(const GlobalDescriptor& a, const GlobalDescriptor& b)
{
    return a.empty() || b.empty() ? 0 : std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}
}  // namespace

SimilarityMatrix::SimilarityMatrix(std::size_t max_frames) : max_frames_(max_frames)
{
    if (max_frames == 0) throw std::invalid_argument("SimilarityMatrix: max_frames is 0");
}

void SimilarityMatrix::add(FrameId frame, const GlobalDescriptor& descriptor)
{
    if (to_index(frame) % frames_per_row_ != 0) return;
    if (descriptors_.size() == max_frames_) thin_out();
    if (to_index(frame) % frames_per_row_ == 0) descriptors_.push_back(descriptor);
}

void SimilarityMatrix::thin_out()
{
    for (std::size_t i = 0; 2 * i < descriptors_.size(); ++i)
        descriptors_[i].swap(descriptors_[2 * i]);
    descriptors_.resize((descriptors_.size() + 1) / 2);
    frames_per_row_ *= 2;
}

std::vector<GlobalDescriptor> SimilarityMatrix::centred() const
{
    auto descriptors = descriptors_;
    const auto mean = mean_of(descriptors);
    for (auto& descriptor : descriptors)
    {
        for (std::size_t i = 0; i < descriptor.size(); ++i)
            descriptor[i] -= static_cast<float>(mean[i]);
        const double norm = std::sqrt(product(descriptor, descriptor));
        if (norm > 0)
            for (auto& value : descriptor) value = static_cast<float>(value / norm);
    }
    return descriptors;
}

void SimilarityMatrix::write_png(const std::string& path) const
{
    const auto descriptors = centred();
    const int side = static_cast<int>(descriptors.size());
    cv::Mat1b picture(std::max(side, 1), std::max(side, 1), uchar{0});
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < row; ++column)
            picture(row, column) = cv::saturate_cast<uchar>(
                255 * product(descriptors[static_cast<std::size_t>(row)],
                              descriptors[static_cast<std::size_t>(column)]));
    std::vector<uchar> png;
    cv::imencode(".png", picture, png);
    WholeFile file(path);
    file.stream().write(reinterpret_cast<const char*>(png.data()),
                        static_cast<std::streamsize>(png.size()));
    file.commit();
}

}  // namespace fild
