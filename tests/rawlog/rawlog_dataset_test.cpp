// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/image_rawlog.h"
#include "fild/rawlog/rawlog_reader.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation.h>

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
