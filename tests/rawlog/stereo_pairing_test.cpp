// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/stereo_pairing.h"

#include "drawn_rawlog.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/paired_rawlog.h"
#include "message_of.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::StereoPairing;
using fild::TInputOptions;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationStereoImages;
using mrpt::poses::CPose3D;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kStart = 1000;
constexpr double kGap = 0.1;  ///< seconds between two images of a camera
constexpr double kLater = 0.004;  ///< the right camera

CObservationImage::Ptr camera_image(const std::string& label, double seconds, double to_the_right)
{
    auto image = image_observation(draw_image(), kStart + seconds, label);
    image->cameraParams.setIntrinsicParamsFromValues(50, 50, 31.5, 23.5);
    image->cameraParams.ncols = 64;
    image->cameraParams.nrows = 48;
    image->cameraPose = CPose3D(1, -to_the_right, 0.5, -M_PI / 2, 0, -M_PI / 2);
    return image;
}

CObservationImage::Ptr left(double seconds)
{
    return camera_image("LEFT", seconds, 0);
}

CObservationImage::Ptr right(double seconds)
{
    return camera_image("RIGHT", seconds, 0.2);
}

TInputOptions named(const std::string& labels)
{
    TInputOptions options;
    options.stereo_labels = labels;
    return options;
}

double seconds_of(const CObservation& observation)
{
    return std::round(1e6 * (mrpt::Clock::toDouble(observation.timestamp) - kStart)) / 1e6;
}

/** What goes on, as text: "LEFT 0.1+" with a right image, "LEFT 0.1-" without, "LEFT 0.1" alone. */
std::string text_of(const CObservation& observation)
{
    std::ostringstream text;
    text << observation.sensorLabel << " " << seconds_of(observation);
    if (const auto* pair = dynamic_cast<const CObservationStereoImages*>(&observation))
        text << (pair->hasImageRight ? "+" : "-");
    return text.str();
}

using Texts = std::vector<std::string>;

Texts texts_of(const StereoPairing::Observations& observations)
{
    Texts texts;
    for (const auto& observation : observations) texts.push_back(text_of(*observation));
    return texts;
}

Texts feed(StereoPairing& pairing, const std::vector<CObservationImage::Ptr>& images)
{
    Texts texts;
    for (const auto& image : images)
        for (const auto& text : texts_of(pairing.feed(*image))) texts.push_back(text);
    return texts;
}

Texts all_of(StereoPairing& pairing, const std::vector<CObservationImage::Ptr>& images)
{
    auto texts = feed(pairing, images);
    for (const auto& text : texts_of(pairing.finish())) texts.push_back(text);
    return texts;
}

/** Images of both cameras in turn. */
std::vector<CObservationImage::Ptr> both_cameras(int from, int to, double later = kLater)
{
    std::vector<CObservationImage::Ptr> images;
    for (int i = from; i < to; ++i)
    {
        images.push_back(left(kGap * i));
        images.push_back(right(kGap * i + later));
    }
    return images;
}

std::string only_note(const StereoPairing& pairing)
{
    const auto notes = pairing.notes();
    EXPECT_EQ(notes.size(), 1U);
    return notes.empty() ? "" : notes.front().text;
}

TEST(StereoPairing, FindsTwoCamerasThatStandAsAPair)
{
    StereoPairing pairing{TInputOptions()};
    EXPECT_THAT(all_of(pairing, both_cameras(0, 3)),
                ElementsAre("LEFT 0+", "LEFT 0.1+", "LEFT 0.2+"));
    const auto report = pairing.report();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->labels.left, "LEFT");
    EXPECT_EQ(report->labels.right, "RIGHT");
    EXPECT_EQ(report->paired, 3U);
    EXPECT_EQ(report->left_alone + report->right_alone, 0U);
    EXPECT_TRUE(pairing.notes().empty());
}

TEST(StereoPairing, KeepsImagesCalibrationsAndPoses)
{
    StereoPairing pairing{TInputOptions()};
    auto second = right(kLater);
    second->cameraParams.setIntrinsicParamsFromValues(60, 61, 30, 20);
    second->image = mrpt::img::CImage(draw_image(CV_8UC1, 30), mrpt::img::DEEP_COPY);
    feed(pairing, {left(0)});
    const auto out = pairing.feed(*second);
    ASSERT_EQ(out.size(), 1U);
    const auto* pair = dynamic_cast<const CObservationStereoImages*>(out.front().get());
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(seconds_of(*pair), 0);
    EXPECT_EQ(pair->rightCamera.fx(), 60);
    EXPECT_EQ(pair->leftCamera.fx(), 50);
    EXPECT_NEAR(pair->rightCameraPose.x(), 0.2, 1e-12);
    EXPECT_NEAR(pair->rightCameraPose.y(), 0, 1e-12);
    EXPECT_NEAR(pair->cameraPose.z(), 0.5, 1e-12);
    EXPECT_EQ(cv::norm(pair->imageRight.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY),
                       draw_image(CV_8UC1, 30),
                       cv::NORM_INF),
              0);
}

TEST(StereoPairing, TakesTheImagesInEitherOrder)
{
    StereoPairing pairing{TInputOptions()};
    EXPECT_THAT(
        all_of(pairing, {right(-0.003), left(0), left(0.1), right(0.104), right(0.197), left(0.2)}),
        ElementsAre("LEFT 0+", "LEFT 0.1+", "LEFT 0.2+"));
}

TEST(StereoPairing, TakesImagesThatComeAFewImagesLate)
{
    StereoPairing pairing{TInputOptions()};
    auto images = both_cameras(0, 1);
    for (int i = 1; i < 10; ++i)
    {
        images.push_back(left(kGap * i));
        if (i > 3) images.push_back(right(kGap * (i - 3) + kLater));
    }
    const auto texts = all_of(pairing, images);
    ASSERT_EQ(texts.size(), 10U);
    EXPECT_EQ(texts[6], "LEFT 0.6+");
    EXPECT_EQ(texts[7], "LEFT 0.7-");
}

TEST(StereoPairing, GivesFramesWithoutARightImageWhereItWasDropped)
{
    StereoPairing pairing{TInputOptions()};
    auto images = both_cameras(0, 6);
    images.erase(images.begin() + 5);  // right 2
    images.erase(images.begin() + 7);  // left 4
    EXPECT_THAT(all_of(pairing, images),
                ElementsAre("LEFT 0+", "LEFT 0.1+", "LEFT 0.2-", "LEFT 0.3+", "LEFT 0.5+"));
    EXPECT_EQ(pairing.report()->left_alone, 1U);
    EXPECT_EQ(pairing.report()->right_alone, 1U);
}

TEST(StereoPairing, BeginsWithARightImageWhoseLeftOneWasDropped)
{
    StereoPairing pairing{TInputOptions()};
    auto images = both_cameras(0, 3);
    images.erase(images.begin());
    EXPECT_THAT(all_of(pairing, images), ElementsAre("LEFT 0.1+", "LEFT 0.2+"));
}

TEST(StereoPairing, FollowsJitterUpToTheTolerance)
{
    StereoPairing pairing{TInputOptions()};
    std::vector<CObservationImage::Ptr> images;
    const double jitter[] = {0.004, -0.019, 0.0199, 0, -0.002, 0.021};
    for (int i = 0; i < 6; ++i)
    {
        images.push_back(left(kGap * i));
        images.push_back(right(kGap * i + jitter[i]));
    }
    EXPECT_THAT(
        all_of(pairing, images),
        ElementsAre("LEFT 0+", "LEFT 0.1+", "LEFT 0.2+", "LEFT 0.3+", "LEFT 0.4+", "LEFT 0.5-"));
}

/** At 100 images a second the image after a dropped one is within the tolerance: pairs would be
 *  wrong from there on. */
TEST(StereoPairing, IsNotMisledByATimeBetweenImagesShorterThanTheTolerance)
{
    StereoPairing pairing{TInputOptions()};
    std::vector<CObservationImage::Ptr> images;
    for (int i = 0; i < 20; ++i)
    {
        images.push_back(left(0.01 * i));
        if (i != 10) images.push_back(right(0.01 * i + 0.001));
    }
    const auto texts = all_of(pairing, images);
    ASSERT_EQ(texts.size(), 20U);
    EXPECT_EQ(pairing.report()->paired, 19U);
    EXPECT_EQ(texts[10], "LEFT 0.1-");
}

TEST(StereoPairing, HoldsEightImagesAtMost)
{
    StereoPairing pairing{TInputOptions()};
    EXPECT_EQ(feed(pairing, both_cameras(0, 2)).size(), 2U);
    for (int i = 2; i < 10; ++i) EXPECT_TRUE(feed(pairing, {left(kGap * i)}).empty()) << i;
    EXPECT_THAT(feed(pairing, {left(1)}), ElementsAre("LEFT 0.2-"));
    EXPECT_THAT(feed(pairing, {left(1.1)}), ElementsAre("LEFT 0.3-"));
    EXPECT_EQ(pairing.finish().size(), 8U);
}

TEST(StereoPairing, GoesOnAfterTheClockWasPutBack)
{
    StereoPairing pairing{TInputOptions()};
    auto images = both_cameras(100, 103);
    for (const auto& image : both_cameras(0, 4)) images.push_back(image);
    const auto texts = all_of(pairing, images);
    ASSERT_EQ(texts.size(), 7U);
    EXPECT_EQ(texts[6], "LEFT 0.3+");
    EXPECT_GE(pairing.report()->paired, 6U);
}

TEST(StereoPairing, TakesImagesWithoutATimeStampAsTheyCome)
{
    StereoPairing pairing(named("LEFT,RIGHT"));
    auto without_time = left(0.2);
    without_time->timestamp = INVALID_TIMESTAMP;
    auto images = both_cameras(0, 2);
    images.push_back(without_time);
    EXPECT_EQ(all_of(pairing, images).size(), 3U);
    EXPECT_EQ(pairing.report()->left_alone, 1U);
}

TEST(StereoPairing, IsOffWhereNobodyWantsIt)
{
    StereoPairing pairing(named("none"));
    EXPECT_FALSE(pairing.takes(*left(0)));
    EXPECT_TRUE(pairing.feed(*left(0)).empty());
    EXPECT_FALSE(pairing.report());
}

TEST(StereoPairing, LetsOneCameraPassWhenNoOtherComes)
{
    StereoPairing pairing{TInputOptions()};
    Texts texts;
    for (int i = 0; i < 5; ++i)
        for (const auto& text : feed(pairing, {left(kGap * i)})) texts.push_back(text);
    EXPECT_EQ(texts.size(), 5U) << "held back until the fifth";
    EXPECT_THAT(feed(pairing, {left(0.5)}), ElementsAre("LEFT 0.5"));
    // The other camera begins later: from there on there are pairs.
    EXPECT_THAT(feed(pairing, both_cameras(6, 9)),
                ElementsAre("LEFT 0.6", "LEFT 0.7+", "LEFT 0.8+"));
}

TEST(StereoPairing, KeepsTheOrderOfOtherCameras)
{
    StereoPairing pairing{TInputOptions()};
    EXPECT_TRUE(feed(pairing, {left(0)}).empty());
    mrpt::obs::CObservationOdometry odometry;
    EXPECT_TRUE(pairing.feed(odometry).empty()) << "no camera";
    mrpt::obs::CObservation3DRangeScan scan;
    scan.sensorLabel = "KINECT";
    scan.hasIntensityImage = true;
    EXPECT_FALSE(pairing.takes(scan));
    EXPECT_THAT(texts_of(pairing.feed(scan)), ElementsAre("LEFT 0")) << "came before";
}

TEST(StereoPairing, LeavesCamerasThatLookElsewhereAlone)
{
    StereoPairing pairing{TInputOptions()};
    std::vector<CObservationImage::Ptr> images;
    for (int i = 0; i < 10; ++i)
    {
        images.push_back(left(kGap * i));
        images.push_back(right(kGap * i + kLater));
        images.back()->cameraPose =
            CPose3D(0, 0, 0.5, M_PI, 0, 0) + images.back()->cameraPose;  // to the rear
    }
    EXPECT_EQ(all_of(pairing, images).size(), 20U);
    EXPECT_FALSE(pairing.report());
    EXPECT_TRUE(pairing.notes().empty());
}

TEST(StereoPairing, TakesTheLeftCameraThatIsWanted)
{
    TInputOptions options;
    options.sensor_label = "RIGHT";
    StereoPairing pairing(options);
    EXPECT_EQ(all_of(pairing, both_cameras(0, 10)).size(), 20U);
    EXPECT_FALSE(pairing.report());
    options.sensor_label = "L.*";
    StereoPairing wanted(options);
    EXPECT_EQ(all_of(wanted, both_cameras(0, 10)).size(), 10U);
}

TEST(StereoPairing, RefusesNamesInTheWrongOrder)
{
    StereoPairing pairing(named("RIGHT, LEFT"));
    EXPECT_THAT(message_of<std::runtime_error>([&] { feed(pairing, both_cameras(0, 1)); }),
                AllOf(HasSubstr("'LEFT' stands to the left of 'RIGHT'"),
                      HasSubstr("stereo_labels = LEFT,RIGHT")));
}

TEST(StereoPairing, NotesABaselineOfZero)
{
    for (const auto* labels : {"", "LEFT,RIGHT"})
    {
        StereoPairing pairing(named(labels));
        std::vector<CObservationImage::Ptr> images;
        for (int i = 0; i < 10; ++i)
            for (const auto* label : {"LEFT", "RIGHT"})
                images.push_back(camera_image(label, kGap * i, 0));
        all_of(pairing, images);
        EXPECT_THAT(only_note(pairing),
                    AllOf(HasSubstr("'LEFT' and 'RIGHT'"), HasSubstr("baseline of 0")));
    }
}

TEST(StereoPairing, NotesACameraWithoutCalibration)
{
    for (const auto* labels : {"", "LEFT,RIGHT"})
    {
        StereoPairing pairing(named(labels));
        auto images = both_cameras(0, 10);
        for (auto& image : images)
            if (image->sensorLabel == "RIGHT") image->cameraParams = {};
        all_of(pairing, images);
        EXPECT_THAT(only_note(pairing), HasSubstr("camera 'RIGHT' is not calibrated"));
    }
}

TEST(StereoPairing, NotesStampsThatAreTooFarApart)
{
    for (const auto* labels : {"", "LEFT,RIGHT"})
    {
        StereoPairing pairing(named(labels));
        all_of(pairing, both_cameras(0, 20, 0.031));
        EXPECT_THAT(only_note(pairing),
                    AllOf(HasSubstr("'LEFT'"),
                          HasSubstr("'RIGHT'"),
                          HasSubstr("0.031 s apart"),
                          HasSubstr("set [input] stereo_tolerance_seconds = 0.038")));
        auto options = named(labels);
        options.stereo_tolerance_seconds = 0.038;
        StereoPairing tolerant(options);
        all_of(tolerant, both_cameras(0, 20, 0.031));
        EXPECT_EQ(tolerant.report()->paired, 20U) << "the advice helps";
    }
}

TEST(StereoPairing, NotesCamerasThatRecordAtDifferentMoments)
{
    StereoPairing pairing(named("LEFT,RIGHT"));
    all_of(pairing, both_cameras(0, 20, kGap / 2));
    EXPECT_THAT(only_note(pairing), HasSubstr("stereo_labels = none"));
}

TEST(StereoPairing, NotesACameraThatStops)
{
    StereoPairing pairing{TInputOptions()};
    auto images = both_cameras(0, 10);
    for (int i = 10; i < 40; ++i) images.push_back(left(kGap * i));
    EXPECT_EQ(all_of(pairing, images).size(), 40U);
    EXPECT_THAT(only_note(pairing),
                AllOf(HasSubstr("camera 'RIGHT' ends 2.996 s before 'LEFT'"),
                      HasSubstr("the last 30 frames")));

    StereoPairing other{TInputOptions()};
    images = both_cameras(0, 10);
    for (int i = 10; i < 40; ++i) images.push_back(right(kGap * i + kLater));
    EXPECT_EQ(all_of(other, images).size(), 10U);
    EXPECT_THAT(only_note(other),
                AllOf(HasSubstr("camera 'LEFT' ends"), HasSubstr("30 images"), HasSubstr("RIGHT")));
}

TEST(StereoPairing, NotesANameThatNoCameraHas)
{
    StereoPairing pairing(named("LEFT,RIHGT"));
    EXPECT_EQ(all_of(pairing, both_cameras(0, 3)).size(), 6U);
    EXPECT_THAT(only_note(pairing), HasSubstr("names camera 'RIHGT'"));
}

TEST(StereoPairing, MakesFramesWithARightImage)
{
    StereoPairing pairing{TInputOptions()};
    fild::FrameBuilder builder(TInputOptions(), "run.rawlog", fild::FrameContent::metric);
    std::vector<fild::Frame> frames;
    for (const auto& image : both_cameras(0, 3))
        for (const auto& observation : pairing.feed(*image))
            if (builder.accepts(*observation)) frames.push_back(builder.build(*observation));
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[2].sensor_label, "LEFT");
    ASSERT_TRUE(frames[2].right);
    EXPECT_NEAR(frames[2].right->left_from_right.translation[0], 0.2, 1e-12);
    EXPECT_NEAR(frames[2].right->seconds_later, kLater, 1e-6);
    EXPECT_TRUE(builder.ignored_camera_labels().empty());
}

TEST(StereoPairing, TakesTheLeftCameraThatIsNamedThoughAnotherComesFirst)
{
    const auto options = named("LEFT,RIGHT");
    StereoPairing pairing(options);
    fild::FrameBuilder builder(options, "run.rawlog");
    std::size_t frames = 0;
    auto images = both_cameras(0, 3);
    images.insert(images.begin(), image_observation(draw_image(), kStart, "WEBCAM"));
    for (const auto& image : images)
        for (const auto& observation : pairing.feed(*image))
            if (builder.accepts(*observation)) ++frames;
    EXPECT_EQ(frames, 3U);
    EXPECT_THAT(builder.ignored_camera_labels(), ElementsAre("WEBCAM"));
}

TEST(PairedRawlog, ReadsPairsToTheEnd)
{
    const TemporaryFolder folder;
    Objects objects;
    for (const auto& image : both_cameras(0, 3)) objects.push_back(image);
    objects.push_back(left(0.3));
    const auto path = folder.path("run.rawlog");
    write_plain(path, objects);
    fild::PairedRawlog rawlog(path, {});
    Texts texts;
    while (const auto observation = rawlog.next()) texts.push_back(text_of(*observation));
    EXPECT_THAT(texts, ElementsAre("LEFT 0+", "LEFT 0.1+", "LEFT 0.2+", "LEFT 0.3-"));
    EXPECT_EQ(rawlog.next(), nullptr);
}

TEST(PairedRawlog, GivesWhatWaitsBeforeDamage)
{
    const TemporaryFolder folder;
    Objects objects;
    for (const auto& image : both_cameras(0, 3)) objects.push_back(image);
    objects.push_back(left(0.3));
    const auto path = folder.path("run.rawlog");
    write_plain(path, objects);
    std::ofstream(path, std::ios::app | std::ios::binary) << "damage";
    fild::PairedRawlog rawlog(path, {});
    for (int i = 0; i < 4; ++i) EXPECT_NE(rawlog.next(), nullptr);
    EXPECT_THROW(rawlog.next(), fild::TruncatedRawlog);
    EXPECT_THROW(rawlog.next(), fild::TruncatedRawlog);
}

}  // namespace
