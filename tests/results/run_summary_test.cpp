// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/run_summary.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

namespace
{
nlohmann::json written(const fild::RunSummary& summary)
{
    const fild::testing::TemporaryFolder folder;
    write_summary(summary, folder.path("summary.json"));
    return nlohmann::json::parse(fild::testing::read_text(folder.path("summary.json")));
}

fild::FrameVerdict verdict_with(std::size_t keypoints, fild::Rejection rejection)
{
    fild::FrameVerdict verdict;
    verdict.keypoints = keypoints;
    verdict.rejection = rejection;
    return verdict;
}

TEST(RunSummary, CountsFramesByVerdict)
{
    fild::RunSummary summary;
    summary.add(verdict_with(100, fild::Rejection::none));
    summary.add(verdict_with(300, fild::Rejection::too_few_inliers));
    summary.add(verdict_with(200, fild::Rejection::too_few_inliers));
    const auto json = written(summary);
    EXPECT_EQ(json["frames"]["camera_frames"], 3);
    EXPECT_EQ(json["frames"]["loop_closures"], 1);
    EXPECT_EQ(json["frames"]["rejections"]["too_few_inliers"], 2);
    EXPECT_EQ(json["frames"]["rejections"].size(), 1U);
    EXPECT_DOUBLE_EQ(json["frames"]["mean_keypoints"], 200);
}

TEST(RunSummary, SaysWhenARunEndedEarly)
{
    fild::RunSummary summary;
    EXPECT_TRUE(written(summary)["complete"].get<bool>());
    summary.ended_early = "interrupted";
    EXPECT_FALSE(written(summary)["complete"].get<bool>());
    EXPECT_EQ(written(summary)["ended_early"], "interrupted");
}

TEST(RunSummary, ListsOptionsAndTimes)
{
    fild::RunSummary summary;
    summary.options = {{"index", {{"backend", "hnsw"}}}};
    fild::StageTimes times;
    times.add("matching", 2.5);
    summary.stage_times = times.statistics();
    summary.camera_frames = 4;
    summary.map_bytes = 4000;
    const auto json = written(summary);
    EXPECT_EQ(json["options"]["index"]["backend"], "hnsw");
    EXPECT_DOUBLE_EQ(json["stage_times_ms"]["matching"]["median"], 2.5);
    EXPECT_EQ(json["memory"]["map_bytes_per_frame"], 1000);
}

TEST(RunSummary, TellsOfTheMap)
{
    fild::RunSummary summary;
    summary.map.trajectory = "recorded";
    summary.map.nodes = 40;
    summary.map.loops_withheld["no_depth"] = 3;
    summary.map.parts = {38, 2};
    summary.map.chi2_before = 12.3456;
    summary.map.notes = {"something"};
    summary.map.sources = {{"gps", "CObservationGPS 'GPS'", 40, 2, 0, 1.5, ""}};
    EXPECT_TRUE(written(summary)["map"]["origin"].is_null());
    summary.map.origin = fild::MapOrigin{36.5, -4.25, 55};
    const auto map = written(summary)["map"];
    EXPECT_EQ(map["trajectory"], "recorded");
    EXPECT_EQ(map["nodes"], 40);
    EXPECT_EQ(map["loops_withheld"]["no_depth"], 3);
    EXPECT_EQ(map["parts"], (std::vector<int>{38, 2}));
    EXPECT_EQ(map["chi2_before"], 12.346);
    EXPECT_EQ(map["notes"][0], "something");
    EXPECT_EQ(map["sources"][0]["name"], "CObservationGPS 'GPS'");
    EXPECT_EQ(map["sources"][0]["without_weight"], 2);
    EXPECT_EQ(map["sources"][0]["noise_scale"], 1.5);
    EXPECT_EQ(map["origin"]["longitude_deg"], -4.25);
}

// The digest of "abc" in FIPS 180-4's example.
TEST(Sha256OfFile, AgreesWithThePublishedExample)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("abc"), "abc");
    EXPECT_EQ(fild::sha256_of_file(folder.path("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_THAT(
        fild::testing::message_of<std::runtime_error>([] { fild::sha256_of_file("no/such/file"); }),
        ::testing::HasSubstr("no/such/file"));
}

}  // namespace
