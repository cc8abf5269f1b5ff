// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_rawlog.h"

#include "drawn_rawlog.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "message_of.h"

#include <opencv2/imgcodecs.hpp>

#include <set>

namespace
{
using namespace fild::testing;
using fild::ImageRawlogRequest;
using fild::StampedImage;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/** Images a.png and b.png in `in`, and another a.png in `in/sub`. */
void draw_images(const TemporaryFolder& folder)
{
    fs::create_directories(folder.path("in/sub"));
    fs::create_directory(folder.path("out"));
    cv::imwrite(folder.path("in/a.png"), draw_image(CV_8UC3, 1));
    cv::imwrite(folder.path("in/b.png"), draw_image(CV_8UC3, 2));
    cv::imwrite(folder.path("in/sub/a.png"), draw_image(CV_8UC3, 3));
}

StampedImage listed(const std::string& path, double seconds)
{
    return {path, "list.txt line 7", seconds};
}

/** Frames that show draw_image() with the seeds 2, 1, 3, 2. */
std::vector<StampedImage> four_frames(const TemporaryFolder& folder)
{
    return {listed(folder.path("in/b.png"), 0),
            listed(folder.path("in/a.png"), 0.1),
            listed(folder.path("in/sub/a.png"), 0.2),
            listed(folder.path("in/sub/../b.png"), 0.3)};
}

ImageRawlogRequest request_in(const TemporaryFolder& folder)
{
    ImageRawlogRequest request;
    request.rawlog_path = folder.path("out/run.rawlog");
    return request;
}

std::size_t entries_in(const std::string& path)
{
    const fs::directory_iterator entries(path);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

void expect_four_frames(const std::string& rawlog)
{
    fild::RawlogReader reader(rawlog);
    fild::FrameBuilder builder(fild::TInputOptions(), rawlog);
    const std::vector<int> seeds{2, 1, 3, 2};
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
        const auto observation = reader.next();
        ASSERT_NE(observation, nullptr);
        ASSERT_TRUE(builder.accepts(*observation));
        const auto frame = builder.build(*observation);
        EXPECT_NEAR(frame.timestamp, 0.1 * static_cast<double>(i), 1e-7);
        EXPECT_EQ(frame.sensor_label, "CAMERA1");
        ASSERT_EQ(frame.defect, fild::Rejection::none);
        EXPECT_EQ(cv::norm(frame.image, draw_image(CV_8UC3, seeds[i]), cv::NORM_INF), 0) << i;
    }
    EXPECT_EQ(reader.next(), nullptr);
}

/** Runs into an error; checks that the output folder is then as it was. */
std::string error_of(const TemporaryFolder& folder,
                     const std::vector<StampedImage>& images,
                     const ImageRawlogRequest& request)
{
    const auto before = entries_in(folder.path("out"));
    auto message =
        message_of<std::runtime_error>([&] { fild::write_image_rawlog(images, request); });
    EXPECT_EQ(entries_in(folder.path("out")), before);
    return message;
}

TEST(ImageRawlog, PutsEachDistinctImageOnceBesideTheRawlog)
{
    const TemporaryFolder folder;
    draw_images(folder);
    const auto summary = fild::write_image_rawlog(four_frames(folder), request_in(folder));
    EXPECT_EQ(summary.frames, 4U);
    EXPECT_EQ(summary.images, 3U);
    EXPECT_EQ(summary.images_dir, folder.path("out/run_Images"));
    EXPECT_EQ(entries_in(folder.path("out")), 2U);
    EXPECT_TRUE(fs::exists(folder.path("out/run_Images/a_2.png"))) << "second of its name";
    EXPECT_EQ(entries_in(folder.path("out/run_Images")), 3U);
    EXPECT_EQ(fs::hard_link_count(folder.path("in/b.png")), 2U) << "linked, not copied";
    expect_four_frames(folder.path("out/run.rawlog"));
}

TEST(ImageRawlog, EmbedsImagesWithoutLoss)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    request.embed = true;
    const auto summary = fild::write_image_rawlog(four_frames(folder), request);
    EXPECT_EQ(summary.images, 3U);
    EXPECT_EQ(entries_in(folder.path("out")), 1U);
    fs::remove_all(folder.path("in"));
    expect_four_frames(folder.path("out/run.rawlog"));
}

TEST(ImageRawlog, FollowsSymbolicLinks)
{
    const TemporaryFolder folder;
    draw_images(folder);
    fs::create_symlink("a.png", folder.path("in/link.png"));
    const auto summary = fild::write_image_rawlog(
        {listed(folder.path("in/link.png"), 0), listed(folder.path("in/a.png"), 1)},
        request_in(folder));
    EXPECT_EQ(summary.images, 1U);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path("out/run_Images/link.png"))));
}

TEST(ImageRawlog, CarriesCalibrationAndLabel)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    request.camera = fild::parse_camera_model("50 51 32 24 64 48 -0.1 0 0 0", "test");
    request.sensor_label = "FRONT";
    fild::write_image_rawlog(four_frames(folder), request);
    fild::FrameBuilder builder(fild::TInputOptions(), request.rawlog_path);
    const auto frame = builder.build(*fild::RawlogReader(request.rawlog_path).next());
    EXPECT_EQ(frame.sensor_label, "FRONT");
    ASSERT_TRUE(frame.camera);
    EXPECT_DOUBLE_EQ(frame.camera->fy, 51);
}

TEST(ImageRawlog, LeavesNothingWhenAnImageIsMissingOrBroken)
{
    const TemporaryFolder folder;
    draw_images(folder);
    for (const bool embed : {false, true})
    {
        auto request = request_in(folder);
        request.embed = embed;
        auto images = four_frames(folder);
        images[2].path = folder.path("in/none.png");
        EXPECT_THAT(error_of(folder, images, request),
                    AllOf(HasSubstr("none.png (list.txt line 7) does not exist")));
        fs::remove(folder.path("in/loop.png"));
        fs::create_symlink("loop.png", folder.path("in/loop.png"));
        images[2].path = folder.path("in/loop.png");
        EXPECT_THAT(error_of(folder, images, request), HasSubstr("loop.png (list.txt line 7)"));
        images[2].path = folder.path("in/broken.png");
        write_text(images[2].path, read_text(folder.path("in/a.png")).substr(0, 100));
        EXPECT_THAT(error_of(folder, images, request),
                    AllOf(HasSubstr("broken.png (list.txt line 7)"), HasSubstr("repair")));
    }
}

TEST(ImageRawlog, RefusesPixelsAndSizesThatCannotBeUsed)
{
    const TemporaryFolder folder;
    draw_images(folder);
    cv::imwrite(folder.path("in/deep.png"), draw_image(CV_16UC1));
    EXPECT_THAT(error_of(folder, {listed(folder.path("in/deep.png"), 0)}, request_in(folder)),
                HasSubstr("8-bit"));
    auto request = request_in(folder);
    request.camera = fild::parse_camera_model("50 51 32 24 640 480", "test");
    EXPECT_THAT(error_of(folder, four_frames(folder), request),
                AllOf(HasSubstr("640x480"), HasSubstr("64x48")));
}

TEST(ImageRawlog, RefusesToReplaceWhatIsThere)
{
    const TemporaryFolder folder;
    draw_images(folder);
    fs::create_directory(folder.path("out/run_Images"));
    EXPECT_THAT(error_of(folder, four_frames(folder), request_in(folder)),
                HasSubstr("run_Images exists already; remove it"));
    write_text(folder.path("out/run.rawlog"), "precious");
    EXPECT_THAT(error_of(folder, four_frames(folder), request_in(folder)),
                HasSubstr("run.rawlog exists already; remove it"));
    EXPECT_EQ(read_text(folder.path("out/run.rawlog")), "precious");
}

TEST(ImageRawlog, RefusesABadRequest)
{
    const TemporaryFolder folder;
    draw_images(folder);
    auto request = request_in(folder);
    EXPECT_THROW(fild::write_image_rawlog({}, request), std::invalid_argument);
    request.sensor_label = "";
    EXPECT_THROW(fild::write_image_rawlog(four_frames(folder), request), std::invalid_argument);
    request = request_in(folder);
    request.rawlog_path = folder.path("out/run.log");
    EXPECT_THROW(fild::write_image_rawlog(four_frames(folder), request), std::invalid_argument);
}

}  // namespace
