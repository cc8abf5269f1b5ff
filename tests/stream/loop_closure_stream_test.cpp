// SPDX-License-Identifier: BSD-3-Clause
#include "fild/stream/loop_closure_stream.h"

#include "drawn_drive.h"
#include "rawlog/drawn_rawlog.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <filesystem>

namespace
{
constexpr std::size_t kFramesPerLap = 8;

fild::TLoopClosureStreamOptions options()
{
    fild::TLoopClosureStreamOptions result;
    auto& network = result.detector.global_descriptor;
    network.model_file = FILD_TINY_NETWORK;
    network.layers = "map";
    network.input_width = 4;
    network.input_height = 4;
    result.detector.index.delay_seconds = 5;
    result.detector.index.candidates = static_cast<int>(2 * kFramesPerLap);
    result.detector.hashing.mutual_check = true;
    result.detector.consistency.consecutive_frames = 1;
    return result;
}

TEST(LoopClosureStream, GivesAVerdictForEveryCameraFrame)
{
    fild::LoopClosureStream stream(options());
    const auto images = fild::testing::draw_two_laps(kFramesPerLap);
    std::size_t loops = 0;
    for (std::size_t i = 0; i < images.size(); ++i)
    {
        const auto observation =
            fild::testing::image_observation(images[i], static_cast<double>(i));
        const auto fed = stream.feed(*observation);
        ASSERT_TRUE(fed.has_value());
        EXPECT_EQ(to_index(fed->frame), i);
        ASSERT_EQ(fed->decided.size(), 1U);
        const auto& verdict = fed->decided.front().verdict;
        EXPECT_EQ(to_index(verdict.frame), i);
        if (!verdict.accepted()) continue;
        ++loops;
        EXPECT_EQ(to_index(verdict.candidate->frame) + kFramesPerLap, i);
    }
    EXPECT_EQ(loops, kFramesPerLap);
    EXPECT_EQ(stream.times().statistics().at("whole_frame").calls, images.size());
    EXPECT_GT(stream.map_bytes(), 0U);
}

TEST(LoopClosureStream, PassesOverOtherObservations)
{
    fild::LoopClosureStream stream(options());
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "ODOMETRY";
    EXPECT_FALSE(stream.feed(odometry).has_value());
    const auto first =
        fild::testing::image_observation(fild::testing::draw_wall(64, 48, 1), 0, "FIRST_CAMERA");
    EXPECT_TRUE(stream.feed(*first).has_value());
    const auto second =
        fild::testing::image_observation(fild::testing::draw_wall(64, 48, 1), 1, "SECOND_CAMERA");
    EXPECT_FALSE(stream.feed(*second).has_value());
    EXPECT_EQ(stream.frames().ignored_camera_labels(), std::vector<std::string>{"SECOND_CAMERA"});
}

TEST(LoadStreamOptions, TakesEveryShippedConfiguration)
{
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FILD_SOURCE_DIR "/config-ini"))
    {
        if (entry.path().filename() == "graphslam_engine.ini") continue;  // MRPT's engine reads it
        ++files;
        auto loaded = fild::load_stream_options(entry.path().string());
        for (const auto& [name, section] : loaded.sections())
            EXPECT_NO_THROW(section->check()) << entry.path() << " [" << name << "]";
    }
    EXPECT_GE(files, 6U);
}

TEST(LoadStreamOptions, RefusesSectionsThatNobodyReads)
{
    const fild::testing::TemporaryFolder folder;
    const auto path = folder.path("run.ini");
    fild::testing::write_text(path, "[render]\nmax_match_pictures = 3\n[runtime]\nseed = 7\n");
    EXPECT_EQ(fild::load_stream_options(path).detector.runtime.seed, 7);
    fild::testing::write_text(path, "[rendr]\nmax_match_pictures = 3\n");
    EXPECT_THROW(fild::load_stream_options(path), std::runtime_error);
}

}  // namespace
