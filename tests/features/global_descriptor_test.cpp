// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/global_descriptor.h"

#include "fild/features/model_file.h"
#include "message_of.h"
#include "temporary_folder.h"

#include <cmath>
#include <cstdlib>

namespace
{
using fild::Backend;
using fild::ChannelOrder;
using fild::GlobalDescriptorExtractor;
using fild::Pooling;
using fild::TGlobalDescriptorOptions;
using fild::testing::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/** The network of make_tiny_network.py, fed with plain pixel values. */
TGlobalDescriptorOptions tiny_network(Backend backend = Backend::onednn)
{
    TGlobalDescriptorOptions options;
    options.backend = backend;
    options.model_file = FILD_TINY_NETWORK;
    options.layers = "map";
    options.input_width = 4;
    options.input_height = 4;
    options.mean = "0";
    options.scale = 1;
    return options;
}

std::vector<float> extract(const TGlobalDescriptorOptions& options, const cv::Mat& image)
{
    return GlobalDescriptorExtractor(options).extract(image).global;
}

/** A 4 x 4 image whose left half is of one colour and right half of another, BGR. */
cv::Mat two_halves(const cv::Scalar& left, const cv::Scalar& right)
{
    cv::Mat image(4, 4, CV_8UC3, left);
    image.colRange(2, 4).setTo(right);
    return image;
}

std::vector<float> unit(const std::vector<double>& values)
{
    double squares = 0;
    for (const auto x : values) squares += x * x;
    std::vector<float> result;
    result.reserve(values.size());
    for (const auto x : values) result.push_back(static_cast<float>(x / std::sqrt(squares)));
    return result;
}

void expect_near(const std::vector<float>& actual, const std::vector<float>& expected)
{
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5) << i;
}

/** With either backend. */
class GlobalDescriptor : public ::testing::TestWithParam<Backend>
{
 protected:
    static TGlobalDescriptorOptions tiny_network() { return ::tiny_network(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Backends,
                         GlobalDescriptor,
                         ::testing::Values(Backend::onednn, Backend::opencv),
                         [](const auto& backend)
                         { return backend.param == Backend::onednn ? "onednn" : "opencv"; });

// BGR (10, 20, 30) is r = 30, g = 20, b = 10; the map's channels are c0 and c1 + 2 c2.
TEST_P(GlobalDescriptor, FeedsChannelsInTheOrderAsked)
{
    const cv::Mat image(4, 4, CV_8UC3, cv::Scalar(10, 20, 30));
    auto options = tiny_network();
    expect_near(extract(options, image), unit({30, 20 + 2 * 10}));
    options.channel_order = ChannelOrder::bgr;
    expect_near(extract(options, image), unit({10, 20 + 2 * 30}));
}

TEST_P(GlobalDescriptor, SubtractsTheMeanThenScales)
{
    const cv::Mat image(4, 4, CV_8UC3, cv::Scalar(10, 20, 30));
    auto options = tiny_network();
    options.mean = "29 18 7";
    options.scale = 0.5;
    expect_near(extract(options, image), unit({1, 2 + 2 * 3}));
}

TEST_P(GlobalDescriptor, AveragesOverTheMap)
{
    const auto image = two_halves({0, 0, 40}, {0, 40, 0});
    expect_near(extract(tiny_network(), image), unit({20, 20}));
}

TEST_P(GlobalDescriptor, TakesTheGeneralisedMean)
{
    const auto image = two_halves({0, 0, 40}, {0, 20, 20});
    auto options = tiny_network();
    options.pooling = Pooling::gem;
    options.gem_power = 2;
    expect_near(extract(options, image),
                unit({std::sqrt((1600. + 400) / 2), std::sqrt((0. + 400) / 2)}));
}

TEST_P(GlobalDescriptor, NormalisesEachCellOfTheGrid)
{
    const auto image = two_halves({0, 0, 40}, {0, 4, 3});
    auto options = tiny_network();
    options.pooling = Pooling::grid;
    options.grid_rows = 1;
    options.grid_columns = 2;
    expect_near(extract(options, image), unit({1, 0, 0.6, 0.8}));
}

TEST_P(GlobalDescriptor, ConcatenatesLayersNormalisedEach)
{
    const cv::Mat image(4, 4, CV_8UC3, cv::Scalar(0, 40, 30));
    auto options = tiny_network();
    options.layers = "map vector";
    expect_near(extract(options, image), unit({0.6, 0.8, 0.6, 0.8}));
}

TEST_P(GlobalDescriptor, TakesGreyAsThreeEqualChannels)
{
    const cv::Mat image(4, 4, CV_8UC1, cv::Scalar(10));
    expect_near(extract(tiny_network(), image), unit({10, 30}));
}

TEST_P(GlobalDescriptor, TakesImagesOfAnySize)
{
    for (const auto& size : {cv::Size(1, 1), cv::Size(640, 3), cv::Size(3, 640)})
        expect_near(extract(tiny_network(), cv::Mat(size, CV_8UC3, cv::Scalar(0, 40, 30))),
                    unit({30, 40}));
}

TEST_P(GlobalDescriptor, OfABlackImageIsAllZeroWithoutBias)
{
    expect_near(extract(tiny_network(), cv::Mat::zeros(4, 4, CV_8UC3)), {0, 0});
}

TEST_P(GlobalDescriptor, RefusesOtherKindsOfImages)
{
    GlobalDescriptorExtractor extractor(tiny_network());
    EXPECT_THROW(extractor.extract(cv::Mat()), std::invalid_argument);
    EXPECT_THROW(extractor.extract(cv::Mat(4, 4, CV_16UC1)), std::invalid_argument);
}

// The left half is (30, 20 + 2 x 10), the right half (60, 40 + 2 x 80): each channel has two
// values, which become -1 and 1.
TEST_P(GlobalDescriptor, TellsWhatTheNetworkSeesInEachCell)
{
    auto options = tiny_network();
    options.cell_layer = "map";
    const auto image = two_halves(cv::Scalar(10, 20, 30), cv::Scalar(80, 40, 60));
    const auto appearance = GlobalDescriptorExtractor(options).extract(image);
    const auto& cells = appearance.cells;
    ASSERT_EQ(cells.rows, 4);
    ASSERT_EQ(cells.columns, 4);
    ASSERT_EQ(cells.channels, 2);
    ASSERT_EQ(cells.values.size(), 32U);
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t c = 0; c < 2; ++c)
            EXPECT_NEAR(cells.values[2 * i + c], i % 4 < 2 ? -1 : 1, 1e-5) << i;
    options.cell_layer.clear();
    expect_near(appearance.global, extract(options, image));
    EXPECT_EQ(GlobalDescriptorExtractor(options).extract(image).cells.size(), 0U);
}

TEST_P(GlobalDescriptor, ChannelsThatDoNotVaryTellNothing)
{
    auto options = tiny_network();
    options.cell_layer = "map";
    const auto cells = GlobalDescriptorExtractor(options)
                           .extract(cv::Mat(4, 4, CV_8UC3, cv::Scalar(10, 20, 30)))
                           .cells;
    for (const float x : cells.values) EXPECT_EQ(x, 0);
}

/** A network of Caffe's that averages each input channel; it has no weights, so that its weights
 * file holds only the network's name (field 1 of caffe.NetParameter). */
TEST(OpenCvNetwork, ReadsCaffeNetworks)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("mean.prototxt"),
                              "name: 'mean'\n"
                              "layer { name: 'data' type: 'Input' top: 'data'\n"
                              "  input_param { shape { dim: 1 dim: 3 dim: 4 dim: 4 } } }\n"
                              "layer { name: 'mean' type: 'Pooling' bottom: 'data' top: 'mean'\n"
                              "  pooling_param { pool: AVE global_pooling: true } }\n");
    fild::testing::write_text(folder.path("mean.caffemodel"), "\n\x04mean");
    auto options = tiny_network(Backend::opencv);
    options.model_file = folder.path("mean.caffemodel");
    options.caffe_prototxt_file = folder.path("mean.prototxt");
    options.layers = "mean";
    expect_near(extract(options, cv::Mat(4, 4, CV_8UC3, cv::Scalar(10, 20, 30))),
                unit({30, 20, 10}));
}

std::string construction_error(const TGlobalDescriptorOptions& options)
{
    return message_of<std::runtime_error>([&] { GlobalDescriptorExtractor extractor(options); });
}

TEST_P(GlobalDescriptor, NamesTheCommandThatGetsAMissingModel)
{
    auto options = tiny_network();
    options.model_file = "/no/such/model.onnx";
    EXPECT_THAT(construction_error(options), HasSubstr("/no/such/model.onnx"));
    EXPECT_THAT(construction_error(options), HasSubstr("datasets-scripts/get-model.sh"));
}

TEST(OpenCvNetwork, BlamesTheMissingOrBadFileOfACaffeNetwork)
{
    const fild::testing::TemporaryFolder folder;
    auto options = tiny_network(Backend::opencv);
    options.caffe_prototxt_file = "/no/such/mean.prototxt";
    EXPECT_THAT(construction_error(options),
                AllOf(HasSubstr("/no/such/mean.prototxt is not there"),
                      HasSubstr("[global_descriptor] caffe_prototxt_file"),
                      Not(HasSubstr("get-model.sh"))));
    options.caffe_prototxt_file = folder.path("bad.prototxt");
    fild::testing::write_text(options.caffe_prototxt_file, "no network");
    EXPECT_THAT(construction_error(options), HasSubstr(options.caffe_prototxt_file));
}

TEST_P(GlobalDescriptor, RefusesAFileThatIsNoModel)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("model.onnx"), "not a model");
    auto options = tiny_network();
    options.model_file = folder.path("model.onnx");
    EXPECT_THAT(construction_error(options), HasSubstr("cannot read " + options.model_file));
}

// OpenCV 4.6 looks for the weights of a layer by their name, and does not look whether they are
// there.
TEST(OpenCvNetwork, RefusesADamagedModelThatCrashesOpenCv)
{
    const fild::testing::TemporaryFolder folder;
    auto bytes = fild::testing::read_text(FILD_TINY_NETWORK);
    const auto name = bytes.rfind("weights");
    ASSERT_NE(name, std::string::npos);
    bytes[name] = 'v';
    fild::testing::write_text(folder.path("damaged.onnx"), bytes);
    auto options = tiny_network(Backend::opencv);
    options.model_file = folder.path("damaged.onnx");
    EXPECT_THAT(
        construction_error(options),
        ::testing::AllOf(HasSubstr("cannot read " + options.model_file), HasSubstr("signal")));
}

TEST_P(GlobalDescriptor, NamesALayerThatIsNotThere)
{
    auto options = tiny_network();
    options.cell_layer = "cell";
    EXPECT_THAT(construction_error(options), AllOf(HasSubstr("cell_layer"), HasSubstr("'cell'")));
    options.cell_layer.clear();
    options.layers = "mapp";
    EXPECT_THAT(construction_error(options), HasSubstr("no layer 'mapp'"));
    EXPECT_THAT(construction_error(options), HasSubstr("vector"));
}

TEST_P(GlobalDescriptor, RefusesAModelOfAnotherDimension)
{
    auto options = tiny_network();
    options.dimension = 1280;
    EXPECT_THAT(construction_error(options),
                HasSubstr("descriptors of 2 numbers, but dimension=1280"));
}

TEST_P(GlobalDescriptor, RefusesAGridFinerThanTheMap)
{
    auto options = tiny_network();
    options.pooling = Pooling::grid;
    options.grid_rows = 5;
    EXPECT_THAT(construction_error(options), HasSubstr("5x2 is finer than the layer's map of 4x4"));
}

TEST(GlobalDescriptorOptions, CheckTheMean)
{
    TGlobalDescriptorOptions options;
    EXPECT_NO_THROW(options.check());
    for (const std::string mean : {"", "1 2", "1 x 3"})
    {
        options.mean = mean;
        EXPECT_THROW(options.check(), std::invalid_argument) << mean;
    }
}

TEST(GlobalDescriptorOptions, RefuseWhatABackendCannotDo)
{
    auto options = tiny_network();
    options.caffe_prototxt_file = "mean.prototxt";
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                AllOf(HasSubstr("caffe_prototxt_file"), HasSubstr("backend = opencv")));
    options = tiny_network(Backend::opencv);
    options.precision = fild::Precision::bf16;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                AllOf(HasSubstr("precision = f32"), HasSubstr("backend = onednn")));
}

void set_variable(const char* name, const std::string& value)
{
    ::setenv(name, value.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): tests have one thread
}

TEST(FindModelFile, LooksInTheDataFolderForABareName)
{
    const fild::testing::TemporaryFolder folder;
    set_variable("XDG_DATA_HOME", folder.path());
    EXPECT_EQ(fild::find_model_file("no-such.onnx"), folder.path("mrpt-fild/no-such.onnx"));
    EXPECT_EQ(fild::find_model_file("some/no-such.onnx"), "some/no-such.onnx");
    set_variable("XDG_DATA_HOME", "not/absolute");  // to be ignored, says the XDG specification
    set_variable("HOME", "/home/nobody");
    EXPECT_EQ(fild::find_model_file("no-such.onnx"),
              "/home/nobody/.local/share/mrpt-fild/no-such.onnx");
}

TEST(FindModelFile, LooksInNoDataFolderWithoutAHome)
{
    ::unsetenv("XDG_DATA_HOME");  // NOLINT(concurrency-mt-unsafe): tests have one thread
    ::unsetenv("HOME");  // NOLINT(concurrency-mt-unsafe): tests have one thread
    EXPECT_EQ(fild::find_model_file("no-such.onnx"), "no-such.onnx");
    set_variable("HOME", "not/absolute");
    EXPECT_EQ(fild::find_model_file("no-such.onnx"), "no-such.onnx");
}

}  // namespace
