// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"

#include "drawn_rawlog.h"
#include "message_of.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <opencv2/imgcodecs.hpp>

namespace
{
using namespace fild::testing;
using fild::FrameBuilder;
using fild::Rejection;
using fild::TInputOptions;
using fild::to_index;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

FrameBuilder default_builder()
{
    return FrameBuilder(TInputOptions(), "/nowhere/run.rawlog");
}

Rejection defect_of(FrameBuilder& builder, const mrpt::obs::CObservation::Ptr& observation)
{
    EXPECT_TRUE(builder.accepts(*observation));
    const auto frame = builder.build(*observation);
    EXPECT_EQ(frame.image.empty(), frame.defect != Rejection::none);
    return frame.defect;
}

bool same_pixels(const cv::Mat& a, const cv::Mat& b)
{
    return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

mrpt::obs::CObservation3DRangeScan::Ptr range_scan(bool with_image)
{
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->sensorLabel = "KINECT";
    scan->timestamp = mrpt::Clock::fromDouble(5);
    scan->hasIntensityImage = with_image;
    if (with_image)
        scan->intensityImage = mrpt::img::CImage(draw_image(CV_8UC3), mrpt::img::DEEP_COPY);
    scan->cameraParamsIntensity.setIntrinsicParamsFromValues(50, 51, 32, 24);
    scan->cameraParamsIntensity.ncols = 64;
    scan->cameraParamsIntensity.nrows = 48;
    return scan;
}

TEST(FrameBuilder, BuildsGreyAndColourFramesInOrder)
{
    auto builder = default_builder();
    const auto grey = image_observation(draw_image(CV_8UC1), 1.5, "EYE");
    const auto colour = image_observation(draw_image(CV_8UC3), 2.5, "EYE");
    ASSERT_TRUE(builder.accepts(*grey));
    const auto first = builder.build(*grey);
    EXPECT_EQ(to_index(first.id), 0U);
    EXPECT_DOUBLE_EQ(first.timestamp, 1.5);
    EXPECT_EQ(first.sensor_label, "EYE");
    EXPECT_EQ(first.defect, Rejection::none);
    EXPECT_FALSE(first.camera);
    EXPECT_TRUE(same_pixels(first.image, draw_image(CV_8UC1)));
    EXPECT_EQ(first.image.data, grey->image.asCvMatRef().data) << "shared, not copied";
    const auto second = builder.build(*colour);
    EXPECT_EQ(to_index(second.id), 1U);
    EXPECT_TRUE(same_pixels(second.image, draw_image(CV_8UC3))) << "BGR stays BGR";
}

TEST(FrameBuilder, TakesTheLeftImageOfAStereoPair)
{
    auto stereo = mrpt::obs::CObservationStereoImages::Create();
    stereo->sensorLabel = "STEREO";
    stereo->timestamp = mrpt::Clock::fromDouble(1);
    stereo->imageLeft = mrpt::img::CImage(draw_image(CV_8UC1, 1), mrpt::img::DEEP_COPY);
    stereo->imageRight = mrpt::img::CImage(draw_image(CV_8UC1, 30), mrpt::img::DEEP_COPY);
    stereo->hasImageRight = true;
    auto builder = default_builder();
    ASSERT_TRUE(builder.accepts(*stereo));
    EXPECT_TRUE(same_pixels(builder.build(*stereo).image, draw_image(CV_8UC1, 1)));
}

TEST(FrameBuilder, TakesTheIntensityImageOfARangeScanIfThereIsOne)
{
    auto builder = default_builder();
    EXPECT_FALSE(builder.accepts(*range_scan(false)));
    ASSERT_TRUE(builder.accepts(*range_scan(true)));
    const auto frame = builder.build(*range_scan(true));
    EXPECT_TRUE(same_pixels(frame.image, draw_image(CV_8UC3)));
    ASSERT_TRUE(frame.camera);
    EXPECT_DOUBLE_EQ(frame.camera->fy, 51);
    EXPECT_THROW(builder.build(*range_scan(false)), std::invalid_argument);
}

TEST(FrameBuilder, StaysWithTheFirstCameraWhenNoLabelIsGiven)
{
    auto builder = default_builder();
    EXPECT_FALSE(builder.accepts(mrpt::obs::CObservationOdometry()));
    EXPECT_TRUE(builder.accepts(*image_observation(draw_image(), 0, "B")));
    EXPECT_FALSE(builder.accepts(*image_observation(draw_image(), 0, "A")));
    EXPECT_TRUE(builder.accepts(*image_observation(draw_image(), 1, "B")));
    EXPECT_THAT(builder.ignored_camera_labels(), ElementsAre("A"));
}

TEST(FrameBuilder, MatchesTheWholeLabelWithARegularExpression)
{
    TInputOptions options;
    options.sensor_label = "CAM[12]";
    FrameBuilder builder(options, "run.rawlog");
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->sensorLabel = "WHEELS";
    EXPECT_FALSE(builder.accepts(*odometry));
    EXPECT_FALSE(builder.accepts(*image_observation(draw_image(), 0, "CAM10")));
    EXPECT_TRUE(builder.accepts(*image_observation(draw_image(), 0, "CAM1")));
    EXPECT_TRUE(builder.accepts(*image_observation(draw_image(), 0, "CAM2")));
    EXPECT_FALSE(builder.accepts(*image_observation(draw_image(), 0, "")));
    EXPECT_EQ(builder.describe_labels(),
              "camera labels there: '' (no label), CAM1, CAM10, CAM2; others: WHEELS");
    EXPECT_THAT(builder.ignored_camera_labels(), ElementsAre("", "CAM10"));
}

TEST(FrameBuilder, SaysThatThereIsNoCamera)
{
    EXPECT_EQ(default_builder().describe_labels(), "camera labels there: none; others: none");
}

TEST(FrameBuilder, RefusesABadRegularExpression)
{
    TInputOptions options;
    options.sensor_label = "[";
    const auto message =
        message_of<std::invalid_argument>([&] { FrameBuilder builder(options, "run.rawlog"); });
    EXPECT_THAT(message, HasSubstr("sensor_label='['"));
}

TEST(FrameBuilder, MarksFramesThatCannotBeUsedAndKeepsTheirIds)
{
    auto builder = default_builder();
    const auto at = [](const cv::Mat& image, double seconds)
    { return image_observation(image, seconds); };
    EXPECT_EQ(defect_of(builder, at(draw_image(CV_32FC1), 1)), Rejection::unsupported_image);
    EXPECT_EQ(defect_of(builder, at(draw_image(), 2)), Rejection::none);
    EXPECT_EQ(defect_of(builder, at(draw_image(), 2)), Rejection::repeated_timestamp);
    EXPECT_EQ(defect_of(builder, at(draw_image(CV_8UC1, 0, {24, 32}), 3)),
              Rejection::image_size_changed);
    EXPECT_EQ(defect_of(builder, at(draw_image(CV_32SC1), 4)), Rejection::unsupported_image);
    EXPECT_EQ(defect_of(builder, at(cv::Mat(), 5)), Rejection::missing_image);
    EXPECT_EQ(defect_of(builder, at(draw_image(), 1)), Rejection::none) << "back in time";
    EXPECT_EQ(to_index(builder.next_id()), 7U);
}

TEST(FrameBuilder, GivesAFrameWithoutATimeStampThatOfTheFrameBefore)
{
    auto builder = default_builder();
    const auto unstamped = image_observation(draw_image(), 0);
    unstamped->timestamp = INVALID_TIMESTAMP;
    EXPECT_EQ(builder.build(*unstamped).timestamp, 0);
    EXPECT_EQ(defect_of(builder, unstamped), Rejection::none) << "no stamp is no repeated stamp";
    builder.build(*image_observation(draw_image(), 7));
    EXPECT_EQ(builder.build(*unstamped).timestamp, 7);
    EXPECT_EQ(defect_of(builder, image_observation(draw_image(), 7)),
              Rejection::repeated_timestamp);
    EXPECT_EQ(defect_of(builder, image_observation(draw_image(), 8)), Rejection::none);
}

TEST(FrameBuilder, UsesAnotherImageWithTheTimeStampOfTheOneBefore)
{
    auto builder = default_builder();
    const auto at = [](int seed, double seconds)
    { return image_observation(draw_image(CV_8UC1, seed), seconds); };
    EXPECT_EQ(defect_of(builder, at(0, 2)), Rejection::none);
    EXPECT_EQ(defect_of(builder, at(20, 2)), Rejection::none) << "stamps in whole seconds";
    EXPECT_EQ(defect_of(builder, at(20, 2)), Rejection::repeated_timestamp);
    EXPECT_EQ(defect_of(builder, at(20, 2)), Rejection::repeated_timestamp);
    EXPECT_EQ(defect_of(builder, at(20, 3)), Rejection::none) << "a robot that stands";
    EXPECT_EQ(defect_of(builder, at(0, 3)), Rejection::none);
}

TEST(FrameBuilder, ReadsImagesOf16Bits)
{
    auto builder = default_builder();
    cv::Mat twelve_bits;  // in 16: values up to 4000
    draw_image(CV_8UC1, 3).convertTo(twelve_bits, CV_16U, 16);
    ASSERT_TRUE(builder.accepts(*image_observation(twelve_bits, 0)));
    const auto frame = builder.build(*image_observation(twelve_bits, 0));
    EXPECT_EQ(frame.defect, Rejection::none);
    ASSERT_EQ(frame.image.type(), CV_8UC1);
    double darkest = 0;
    double brightest = 0;
    cv::minMaxLoc(frame.image, &darkest, &brightest);
    EXPECT_EQ(darkest, 0);
    EXPECT_EQ(brightest, 255);
    cv::Mat dim;  // 8 bits of noise at most are not spread
    draw_image(CV_8UC3, 3).convertTo(dim, CV_16U, 0.1);
    const auto colour = builder.build(*image_observation(dim, 1));
    ASSERT_EQ(colour.image.type(), CV_8UC3);
    cv::minMaxLoc(colour.image.reshape(1), &darkest, &brightest);
    EXPECT_EQ(brightest - darkest, 25 - 2);
}

TEST(FrameBuilder, SaysWhatIsWrongWithPixelsThatItCannotUse)
{
    auto builder = default_builder();
    EXPECT_EQ(builder.first_unsupported_image(), "");
    builder.build(*image_observation(draw_image(), 0));
    builder.build(*image_observation(draw_image(CV_32FC1), 1));
    builder.build(*image_observation(draw_image(CV_64FC1), 2));
    EXPECT_EQ(builder.first_unsupported_image(), "frame 1: 32 bit floating point, 1 channel");
}

TEST(FrameBuilder, WritesLabelsInUtf8)
{
    TInputOptions options;
    options.sensor_label = "K\xC3\xA4mera";
    FrameBuilder builder(options, "/nowhere/run.rawlog");
    for (const std::string label : {"K\xE4mera", "K\xC3\xA4mera"})  // Latin-1, UTF-8
    {
        const auto observation = image_observation(draw_image(), 0, label);
        ASSERT_TRUE(builder.accepts(*observation));
        EXPECT_EQ(builder.build(*observation).sensor_label, options.sensor_label);
    }
    EXPECT_EQ(builder.describe_labels(), "camera labels there: K\xC3\xA4mera; others: none");
}

/** An observation whose camera is calibrated for another size than its images, 64x48. */
mrpt::obs::CObservationImage::Ptr wrongly_calibrated(int width, int height, double cx, double cy)
{
    auto observation = image_observation(draw_image(), 0);
    observation->cameraParams.setIntrinsicParamsFromValues(100, 101, cx, cy);
    observation->cameraParams.ncols = static_cast<std::uint32_t>(width);
    observation->cameraParams.nrows = static_cast<std::uint32_t>(height);
    return observation;
}

TEST(FrameBuilder, GoesOnWithoutACalibrationForAnotherImageSize)
{
    auto builder = default_builder();
    const auto frame = builder.build(*wrongly_calibrated(320, 240, 160, 120));
    EXPECT_EQ(frame.defect, Rejection::none);
    EXPECT_FALSE(frame.camera);
    auto twice = wrongly_calibrated(320, 240, 160, 120);
    twice->timestamp = mrpt::Clock::fromDouble(1);
    builder.build(*twice);
    EXPECT_THAT(builder.calibration_notes(),
                ElementsAre("the calibration of camera 'CAMERA1' is for 320x240 pixels, its images "
                            "have 64x48: it is not used; if the images were made smaller, set "
                            "[input] camera_parameters = 20 20.2 31.6 23.6 64 48"));
}

TEST(FrameBuilder, SaysTheNumbersThatMendACalibration)
{
    auto only_size = default_builder();  // the principal point is in the middle of the images
    only_size.build(*wrongly_calibrated(640, 480, 31.5, 24));
    EXPECT_THAT(only_size.calibration_notes(),
                ElementsAre(HasSubstr("if only the size is wrong, set [input] camera_parameters = "
                                      "100 101 31.5 24 64 48")));
    auto distorted = default_builder();
    auto observation = wrongly_calibrated(128, 96, 64, 48);
    observation->cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
    observation->cameraParams.dist = {0.1, 0.01, 0.001, 0.002, 0.5};
    distorted.build(*observation);
    EXPECT_THAT(distorted.calibration_notes(),
                ElementsAre(HasSubstr("= 50 50.5 31.75 23.75 64 48 0.1 0.01 0.001 0.002 0.5")));
    auto cropped = default_builder();
    cropped.build(*wrongly_calibrated(640, 200, 320, 100));
    EXPECT_THAT(cropped.calibration_notes(),
                ElementsAre(AllOf(HasSubstr("640x200"), HasSubstr("calibrate it for that size"))));
}

TEST(FrameBuilder, DropsAlpha)
{
    auto builder = default_builder();
    const auto frame = builder.build(*image_observation(draw_image(CV_8UC4), 0));
    EXPECT_TRUE(same_pixels(frame.image, draw_image(CV_8UC3)));
}

TEST(FrameBuilder, SkippingCountsAsBuildingDoes)
{
    auto builder = default_builder();
    builder.skip(*external_observation("none.png", 1));
    builder.skip(*image_observation(draw_image(), 2));
    EXPECT_EQ(to_index(builder.next_id()), 2U);
    EXPECT_EQ(to_index(builder.build(*image_observation(draw_image(), 3)).id), 2U);
}

/** A folder with `run.rawlog`'s images in the sub-folder `dir`. */
void write_image(const TemporaryFolder& folder, const std::string& dir, const std::string& name)
{
    std::filesystem::create_directories(folder.path(dir));
    cv::imwrite(folder.path(dir + "/" + name), draw_image(CV_8UC3, 5));
}

TEST(FrameBuilder, FindsExternalImagesBesideTheRawlog)
{
    for (const std::string dir : {"run_Images", "run_images", "run_IMAGES", "Images"})
    {
        const TemporaryFolder folder;
        write_image(folder, dir, "a b.png");
        FrameBuilder builder(TInputOptions(), folder.path("run.rawlog"));
        const auto frame = builder.build(*external_observation("a b.png", 0));
        EXPECT_TRUE(same_pixels(frame.image, draw_image(CV_8UC3, 5))) << dir;
    }
}

TEST(FrameBuilder, FindsExternalImagesBesideTheFileThatARawlogIsALinkTo)
{
    const TemporaryFolder folder;
    write_image(folder, "data/run_Images", "a.png");
    write_text(folder.path("data/run.rawlog"), "");
    std::filesystem::create_symlink("data/run.rawlog", folder.path("link.rawlog"));
    FrameBuilder builder(TInputOptions(), folder.path("link.rawlog"));
    EXPECT_EQ(defect_of(builder, external_observation("a.png", 0)), Rejection::none);
}

TEST(FrameBuilder, FindsExternalImagesInANamedFolderAndByAbsolutePath)
{
    const TemporaryFolder folder;
    write_image(folder, "elsewhere", "a.png");
    TInputOptions options;
    options.images_dir = folder.path("elsewhere");
    FrameBuilder named(options, "/nowhere/run.rawlog");
    EXPECT_EQ(defect_of(named, external_observation("a.png", 0)), Rejection::none);
    auto unnamed = default_builder();
    EXPECT_EQ(defect_of(unnamed, external_observation(folder.path("elsewhere/a.png"), 0)),
              Rejection::none);
}

TEST(FrameBuilder, LooksInTheNamedFolderForImagesOfAnotherComputer)
{
    const TemporaryFolder folder;
    write_image(folder, "elsewhere/left", "a.png");
    TInputOptions options;
    options.images_dir = folder.path("elsewhere");
    FrameBuilder builder(options, "/nowhere/run.rawlog");
    double seconds = 0;
    for (const std::string name : {"/home/someone/elsewhere/left/a.png",
                                   R"(C:\data\run_Images\left\a.png)",
                                   R"(left\a.png)"})
        EXPECT_EQ(defect_of(builder, external_observation(name, seconds++)), Rejection::none)
            << name;
    options.images_dir = folder.path("elsewhere/left");
    FrameBuilder inside(options, "/nowhere/run.rawlog");
    EXPECT_EQ(defect_of(inside, external_observation("/home/someone/left/a.png", 0)),
              Rejection::none);
    EXPECT_EQ(defect_of(inside, external_observation("/home/someone/b.png", 1)),
              Rejection::missing_image);
    EXPECT_EQ(inside.first_missing_image(), "/home/someone/b.png");
    EXPECT_EQ(defect_of(inside, external_observation("right/a.png", 2)), Rejection::missing_image)
        << "is not left/a.png";
}

TEST(FrameBuilder, FindsImagesWhoseEndingIsWrittenInOtherLetters)
{
    const TemporaryFolder folder;
    write_image(folder, "run_Images", "a.jpg");
    write_image(folder, "run_Images", "b.PNG");
    FrameBuilder builder(TInputOptions(), folder.path("run.rawlog"));
    EXPECT_EQ(defect_of(builder, external_observation("a.JPG", 0)), Rejection::none);
    EXPECT_EQ(defect_of(builder, external_observation("b.png", 1)), Rejection::none);
    EXPECT_EQ(defect_of(builder, external_observation("A.jpg", 2)), Rejection::missing_image);
}

TEST(FrameBuilder, TellsImagesThatAreThereFromThoseThatAreMissing)
{
    const TemporaryFolder folder;
    write_image(folder, "run_Images", "good.jpg");
    write_text(folder.path("run_Images/broken.jpg"), "no image");
    FrameBuilder builder(TInputOptions(), folder.path("run.rawlog"));
    builder.build(*external_observation("broken.jpg", 0));
    EXPECT_EQ(builder.first_missing_image(),
              folder.path("run_Images/broken.jpg") + ", which cannot be read");
}

TEST(FrameBuilder, SkipsMissingAndBrokenImages)
{
    const TemporaryFolder folder;
    write_image(folder, "run_Images", "good.jpg");
    const auto whole = read_text(folder.path("run_Images/good.jpg"));
    write_text(folder.path("run_Images/broken.jpg"), whole.substr(0, whole.size() / 2));
    FrameBuilder builder(TInputOptions(), folder.path("run.rawlog"));
    EXPECT_EQ(defect_of(builder, external_observation("none.jpg", 0)), Rejection::missing_image);
    EXPECT_EQ(defect_of(builder, external_observation("broken.jpg", 1)), Rejection::missing_image);
    EXPECT_EQ(defect_of(builder, external_observation("good.jpg", 2)), Rejection::none);
}

TEST(FrameBuilder, StopsAtAMissingImageWhereToldSo)
{
    const TemporaryFolder folder;
    TInputOptions options;
    options.on_missing_image = fild::OnMissingImage::stop;
    FrameBuilder builder(options, folder.path("run.rawlog"));
    const auto message = message_of<std::runtime_error>(
        [&] { builder.build(*external_observation("none.jpg", 0)); });
    EXPECT_THAT(message,
                AllOf(HasSubstr(folder.path("run_Images/none.jpg")),
                      HasSubstr("images_dir"),
                      HasSubstr("on_missing_image=skip")));
    EXPECT_THROW(builder.build(mrpt::obs::CObservationImage()), std::runtime_error);
}

}  // namespace
