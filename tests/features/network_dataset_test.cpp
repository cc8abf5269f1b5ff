// SPDX-License-Identifier: BSD-3-Clause
// oneDNN against OpenCV on real images, with the network of get-model.sh, see
// ../shared/data/README.md.
#include "compared_maps.h"
#include "fild/features/global_descriptor.h"
#include "fild/features/model_file.h"
#include "onednn_network.h"
#include "opencv_network.h"

#include <gtest/gtest.h>
#include <opencv2/dnn.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace
{
using fild::Backend;
using fild::GlobalDescriptorExtractor;
using fild::Precision;
using fild::TGlobalDescriptorOptions;
using fild::testing::cosine;

std::vector<cv::Mat> images_of(const std::string& folder)
{
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    std::vector<cv::Mat> images;
    constexpr std::size_t kImages = 10;
    for (std::size_t i = 0; i < kImages; ++i)
        images.push_back(cv::imread(paths[i * paths.size() / kImages]));
    return images;
}

class NetworkDataset : public ::testing::TestWithParam<const char*>
{
 protected:
    void SetUp() override
    {
        for (const auto& path : {folder_, options_.model_file})
            if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
        images_ = images_of(folder_);
    }

    /** Least cosine between the maps of the two backends. */
    double least_cosine(Precision precision) const
    {
        auto options = options_;
        const auto reference = fild::read_opencv_network(options);
        options.precision = precision;
        const auto network = fild::read_onednn_network(options);
        double least = 1;
        for (const auto& image : images_)
        {
            const auto blob =
                cv::dnn::blobFromImage(image, 1 / 127.5, {300, 300}, cv::Scalar::all(127.5), true);
            const auto expected = reference->forward(blob);
            const auto actual = network->forward(blob);
            for (std::size_t i = 0; i < expected.size(); ++i)
                least = std::min(least, cosine(expected[i], actual[i]));
        }
        return least;
    }

    double least_cosine_of_descriptors(Precision precision) const
    {
        auto options = options_;
        options.pooling = fild::Pooling::grid;
        options.backend = Backend::opencv;
        GlobalDescriptorExtractor reference(options);
        options.backend = Backend::onednn;
        options.precision = precision;
        GlobalDescriptorExtractor extractor(options);
        double least = 1;
        for (const auto& image : images_)
            least = std::min(least,
                             cosine(cv::Mat(reference.extract(image).global, true),
                                    cv::Mat(extractor.extract(image).global, true)));
        return least;
    }

    void expect_alike(Precision precision, double least) const
    {
        const auto maps = least_cosine(precision);
        const auto descriptors = least_cosine_of_descriptors(precision);
        std::cout << "least cosine: maps " << maps << ", descriptors " << descriptors << "\n";
        EXPECT_GE(maps, least);
        EXPECT_GE(descriptors, least);
    }

    static TGlobalDescriptorOptions real_network()
    {
        TGlobalDescriptorOptions options;
        options.model_file = fild::find_model_file(options.model_file);
        const std::string prefix = "FeatureExtractor/MobilenetV2/";
        options.layers = prefix + "expanded_conv_14/add " + prefix + "Conv_1/Relu6";
        options.cell_layer = prefix + "expanded_conv_9/add";
        return options;
    }

    std::string folder_ = std::string(FILD_TEST_DATA_DIR "/") + GetParam();
    TGlobalDescriptorOptions options_ = real_network();
    std::vector<cv::Mat> images_;
};

TEST_P(NetworkDataset, OneDnnAgreesWithOpenCv)
{
    expect_alike(Precision::f32, 0.9999);
}

TEST_P(NetworkDataset, OneDnnAgreesWithOpenCvInBf16)
{
    if (!fild::processor_has_bf16()) GTEST_SKIP() << "the processor has no bf16";
    expect_alike(Precision::mixed, 0.999);
    expect_alike(Precision::bf16, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Sets,
                         NetworkDataset,
                         ::testing::Values("corridor/images", "kitti03/images"),
                         [](const auto& set)
                         { return std::string(set.index == 0 ? "Corridor" : "Kitti03"); });

}  // namespace
