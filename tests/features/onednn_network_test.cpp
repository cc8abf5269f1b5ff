// SPDX-License-Identifier: BSD-3-Clause
#include "onednn_network.h"

#include "compared_maps.h"
#include "message_of.h"
#include "opencv_network.h"
#include "temporary_folder.h"

#include <algorithm>
#include <filesystem>
#include <omp.h>
#include <random>
#include <thread>

namespace
{
using fild::Precision;
using fild::TGlobalDescriptorOptions;
using fild::testing::are_same;
using fild::testing::cosine;
using fild::testing::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

/** The network of make_residual_network.py. */
TGlobalDescriptorOptions residual_network(const std::string& layers)
{
    TGlobalDescriptorOptions options;
    options.model_file = FILD_RESIDUAL_NETWORK;
    options.layers = layers;
    options.input_width = 24;
    options.input_height = 20;
    return options;
}

/** Of its layers, those in the middle of what is computed as one, too. OpenCV 4.6 does not give
 *  back
 * a batch normalisation that it merges. */
const std::string kAllKinds =
    "first first/relu one/expand/relu6 one/depthwise one/project one/add two/depthwise "
    "two/depthwise/relu6 two/project/bn three/add again groups groups/relu sum alone/relu6 last "
    "flat "
    "reduced vector";

cv::Mat random_blob(const TGlobalDescriptorOptions& options)
{
    const int shape[] = {1, 3, options.input_height, options.input_width};
    cv::Mat blob(4, shape, CV_32F);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> pixel(-1, 1);
    std::generate_n(blob.ptr<float>(), blob.total(), [&] { return pixel(random); });
    return blob;
}

std::vector<cv::Mat> forward(const TGlobalDescriptorOptions& options)
{
    return fild::read_onednn_network(options)->forward(random_blob(options));
}

std::vector<cv::Mat> reference(const TGlobalDescriptorOptions& options)
{
    return fild::read_opencv_network(options)->forward(random_blob(options));
}

void expect_alike(const std::vector<cv::Mat>& maps,
                  const std::vector<cv::Mat>& others,
                  double least_cosine)
{
    ASSERT_EQ(maps.size(), others.size());
    for (std::size_t i = 0; i < maps.size(); ++i)
    {
        ASSERT_EQ(maps[i].size[1], others[i].size[1]) << i;
        ASSERT_EQ(maps[i].total(), others[i].total()) << i;
        EXPECT_GT(cosine(maps[i], others[i]), least_cosine) << i;
    }
}

std::string error_of(const TGlobalDescriptorOptions& options)
{
    return message_of<std::runtime_error>([&] { fild::read_onednn_network(options); });
}

/** The file with a text replaced, everywhere, by one of the same length. */
std::string replaced(std::string bytes, const std::string& text, const std::string& by)
{
    EXPECT_EQ(text.size(), by.size());
    for (auto at = bytes.find(text); at != std::string::npos; at = bytes.find(text, at + 1))
        bytes.replace(at, text.size(), by);
    return bytes;
}

TEST(OneDnnNetwork, AgreesWithOpenCvOnEveryKindOfLayer)
{
    const auto options = residual_network(kAllKinds);
    expect_alike(forward(options), reference(options), 0.999999);
}

TEST(OneDnnNetwork, AgreesWithOpenCvWhenLayersAreComputedAsOne)
{
    for (const auto* layer : {"one/add", "again", "identity", "vector"})
    {
        const auto options = residual_network(layer);
        expect_alike(forward(options), reference(options), 0.999999);
    }
}

TEST(OneDnnNetwork, ComputesInBf16WhereTheProcessorHasIt)
{
    auto options = residual_network(kAllKinds);
    const auto exact = forward(options);
    options.precision = Precision::bf16;
    if (!fild::processor_has_bf16())
    {
        EXPECT_THAT(error_of(options), AllOf(HasSubstr("bf16"), HasSubstr("precision = f32")));
        return;
    }
    const auto rounded = forward(options);
    expect_alike(rounded, exact, 0.999);
    EXPECT_FALSE(are_same(rounded.front(), exact.front()));
    options.precision = Precision::mixed;
    const auto mixed = forward(options);
    expect_alike(mixed, exact, 0.999);
    EXPECT_TRUE(are_same(mixed.front(), exact.front()));  // half of the image's size
    EXPECT_FALSE(are_same(mixed.back(), exact.back()));
}

auto count_threads()
{
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST(OneDnnNetwork, TakesOneThreadWhateverOpenMpMayTake)
{
    const auto options = residual_network(kAllKinds);
    omp_set_num_threads(1);
    const auto expected = forward(options);
    omp_set_num_threads(3);
    const auto before = count_threads();
    const auto actual = forward(options);
    EXPECT_EQ(count_threads(), before);
    EXPECT_EQ(omp_get_max_threads(), 3);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_TRUE(are_same(actual[i], expected[i])) << i;
}

TEST(OneDnnNetwork, RunsInAnotherThreadThanItWasMadeIn)
{
    const auto options = residual_network("vector");
    const auto here = forward(options);
    const auto network = fild::read_onednn_network(options);
    cv::Mat there;
    std::thread([&] { there = network->forward(random_blob(options))[0].clone(); }).join();
    EXPECT_TRUE(are_same(here[0], there));
}

TEST(OneDnnNetwork, RunsAgain)
{
    const auto options = residual_network(kAllKinds);
    const auto network = fild::read_onednn_network(options);
    std::vector<cv::Mat> first;
    for (const auto& map : network->forward(random_blob(options))) first.push_back(map.clone());
    network->forward(cv::Mat::zeros(4, random_blob(options).size.p, CV_32F));
    const auto again = network->forward(random_blob(options));
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_TRUE(are_same(first[i], again[i])) << i;
}

TEST(OneDnnNetwork, NamesAnUnsupportedLayerAndTheWayOut)
{
    const fild::testing::TemporaryFolder folder;
    auto options = residual_network("vector");
    options.model_file = folder.path("asin.onnx");
    fild::testing::write_text(
        options.model_file,
        replaced(fild::testing::read_text(FILD_RESIDUAL_NETWORK), "Relu", "Asin"));
    EXPECT_THAT(error_of(options),
                AllOf(HasSubstr("cannot read " + options.model_file),
                      HasSubstr("layer 'first/relu' is a Asin"),
                      HasSubstr("[global_descriptor] backend = opencv")));
}

TEST(OneDnnNetwork, DoesNotReadLayersBehindTheWantedOnes)
{
    const fild::testing::TemporaryFolder folder;
    auto options = residual_network("three/add");
    const auto expected = forward(options);
    options.model_file = folder.path("abcdefgh.onnx");
    fild::testing::write_text(
        options.model_file,
        replaced(fild::testing::read_text(FILD_RESIDUAL_NETWORK), "Reshape", "Abcdefg"));
    expect_alike(forward(options), expected, 0.999999);
}

TEST(OneDnnNetwork, RefusesAMissingConstant)
{
    const fild::testing::TemporaryFolder folder;
    auto options = residual_network("vector");
    options.model_file = folder.path("damaged.onnx");
    auto bytes = fild::testing::read_text(FILD_RESIDUAL_NETWORK);
    const auto name = bytes.rfind("first/weights");
    ASSERT_NE(name, std::string::npos);
    bytes[name] = 'F';
    fild::testing::write_text(options.model_file, bytes);
    EXPECT_THAT(error_of(options), AllOf(HasSubstr("layer 'first'"), HasSubstr("'first/weights'")));
}

TEST(OneDnnNetwork, RefusesMapsThatTakeTooMuchMemory)
{
    auto options = residual_network("one/add");
    options.input_width = options.input_height = 10000;
    EXPECT_THAT(error_of(options), AllOf(HasSubstr("512 MB"), HasSubstr("input_width")));
}

}  // namespace
