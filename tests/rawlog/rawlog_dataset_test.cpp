// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/image_layouts.h"
#include "fild/rawlog/image_rawlog.h"
#include "fild/rawlog/rawlog_reader.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation.h>
#include <opencv2/imgcodecs.hpp>

namespace
{
namespace fs = std::filesystem;

std::vector<fild::Frame> frames_of(const std::string& rawlog)
{
    fild::RawlogReader reader(rawlog);
    fild::FrameBuilder builder(fild::TInputOptions(), rawlog);
    std::vector<fild::Frame> frames;
    while (const auto observation = reader.next())
        if (builder.accepts(*observation)) frames.push_back(builder.build(*observation));
    return frames;
}

TEST(CorridorDataset, GoesIntoARawlogAndBack)
{
    const std::string images_dir = FILD_TEST_DATA_DIR "/corridor/images";
    if (!fs::exists(images_dir)) GTEST_SKIP() << "no such folder: " << images_dir;
    const auto images = fild::stamp_images(fild::list_image_folder(images_dir), {"", 1.0});
    const fild::testing::TemporaryFolder folder;
    fild::ImageRawlogRequest request;
    request.rawlog_path = folder.path("corridor.rawlog");
    fild::write_image_rawlog(fild::mono_recording(images), request);
    const auto frames = frames_of(request.rawlog_path);
    ASSERT_EQ(frames.size(), 84U);
    for (const auto& frame : frames)
    {
        EXPECT_EQ(frame.defect, fild::Rejection::none);
        EXPECT_EQ(frame.image.size(), cv::Size(512, 384));
        EXPECT_NEAR(frame.timestamp, static_cast<double>(to_index(frame.id)), 1e-6);
    }
}

/** Copies an image of the data under a name of a layout; the copy must be of `extension`'s kind. */
void copy_as(const std::string& image, const std::string& target)
{
    const std::string source = FILD_TEST_DATA_DIR "/pairs/" + image;
    if (fs::path(source).extension() == fs::path(target).extension())
        fs::copy_file(source, target);
    else
        cv::imwrite(target, cv::imread(source, cv::IMREAD_UNCHANGED));
}

TEST(PairsDataset, GoesIntoARawlogByTheNamesOfMalagaAndNewCollege)
{
    const std::string pairs = FILD_TEST_DATA_DIR "/pairs";
    if (!fs::exists(pairs)) GTEST_SKIP() << "no such folder: " << pairs;
    const fild::testing::TemporaryFolder folder;
    fs::create_directory(folder.path("malaga"));
    fs::create_directory(folder.path("college"));
    copy_as("malaga6l_a.jpg", folder.path("malaga/CAMERA_LEFT_1226322120.504112.jpg"));
    copy_as("malaga6l_b.jpg", folder.path("malaga/CAMERA_LEFT_1226322307.261530.jpg"));
    copy_as("newcollege_a.png", folder.path("college/StereoImage__1225719815.864878-left.pnm"));
    copy_as("newcollege_b.png", folder.path("college/StereoImage__1225719816.864764-left.pnm"));

    const auto frames_as = [&](const std::string& name, const fild::Recording& recording)
    {
        fild::ImageRawlogRequest request;
        request.rawlog_path = folder.path(name + ".rawlog");
        fild::write_image_rawlog(recording, request);
        return frames_of(request.rawlog_path);
    };
    const auto malaga = frames_as("malaga", fild::read_malaga_layout(folder.path("malaga"), {}));
    ASSERT_EQ(malaga.size(), 2U);
    EXPECT_EQ(malaga[1].image.size(), cv::Size(1024, 768));
    EXPECT_NEAR(malaga[1].timestamp, 1226322307.261530, 1e-6);
    const auto college =
        frames_as("college", fild::read_newcollege_layout(folder.path("college"), {}));
    ASSERT_EQ(college.size(), 2U);
    EXPECT_EQ(college[0].image.size(), cv::Size(512, 384));
    EXPECT_EQ(college[0].defect, fild::Rejection::none);
}

/** All file names that the authors of FILD ran, as empty files. */
TEST(GroundTruthFrames, AreNamesThatTheLayoutsRead)
{
    using Read = fild::Recording (*)(const std::string&, const std::optional<fild::Calibration>&);
    const std::vector<std::pair<std::string, Read>> lists{
        {"malaga6l_frames.txt", fild::read_malaga_layout},
        {"newcollege_frames_2624.txt", fild::read_newcollege_layout}};
    for (const auto& [list, read] : lists)
    {
        const auto path = FILD_TEST_DATA_DIR "/ground_truth/" + list;
        if (!fs::exists(path)) GTEST_SKIP() << "no such file: " << path;
        const fild::testing::TemporaryFolder folder;
        const auto names = fild::read_image_list(path);
        for (const auto& name : names)
            fild::testing::write_text(folder.path(fs::path(name.path).filename()), "");
        EXPECT_EQ(read(folder.path(), std::nullopt).frames.size(), names.size());
    }
}

TEST(MrptDatasets, StreamToTheirEnd)
{
    const std::string folder = "/usr/share/mrpt/datasets";
    if (!fs::exists(folder + "/tests_rgbd.rawlog"))
        GTEST_SKIP() << "no " << folder << "/tests_rgbd.rawlog (Debian package mrpt-common)";
    for (const auto& entry : fs::directory_iterator(folder))
    {
        if (entry.path().extension() != ".rawlog") continue;
        fild::RawlogReader reader(entry.path().string());
        std::size_t count = 0;
        while (reader.next()) ++count;
        EXPECT_GT(count, 0U) << entry.path();
    }
}

TEST(MrptDatasets, GiveTheFramesOfAnRgbdCamera)
{
    const std::string path = "/usr/share/mrpt/datasets/tests_rgbd.rawlog";
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path << " (Debian package mrpt-common)";
    const auto frames = frames_of(path);
    ASSERT_FALSE(frames.empty());
    EXPECT_TRUE(frames[0].camera);
    EXPECT_FALSE(frames[0].image.empty());
}

}  // namespace
