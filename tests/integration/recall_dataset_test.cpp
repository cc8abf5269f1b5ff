// SPDX-License-Identifier: BSD-3-Clause
// The two apps on real recordings: what the project promises of recall and precision.
#include "fild/features/model_file.h"
#include "frames_csv.h"
#include "run_command.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace
{
using fild::testing::FrameRow;
using fild::testing::lines_of;
using fild::testing::read_text;
using fild::testing::TemporaryFolder;

const std::string kData = FILD_TEST_DATA_DIR;
const std::string kConfigs = FILD_SOURCE_DIR "/config-ini/";

/** The first of the paths that is missing, or nothing. */
std::string missing_of(const std::vector<std::string>& paths)
{
    for (const auto& path : paths)
        if (!std::filesystem::exists(path)) return path;
    return "";
}

/** Writes a list of images into a rawlog and runs the main job on it. */
std::vector<FrameRow> run(const std::string& image_list,
                          const std::string& config,
                          const std::string& more)
{
    const TemporaryFolder folder;
    fild::testing::write_text(folder.path("list.txt"), image_list);
    const auto finished = fild::testing::run_command(
        "cd '" + folder.path() +
        "' && '" IMAGES_TO_RAWLOG "' --list list.txt --output run.rawlog && '" RAWLOG_LOOP_CLOSURE
        "' --quiet --rawlog run.rawlog --output out --config '" +
        kConfigs + config + "' --set render.max_match_pictures=0 " + more);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return fild::testing::read_frames_csv(folder.path("out/frames.csv"));
}

/** Loop closures against a truth: does frame `query` show the place of frame `candidate`? */
struct Score
{
    std::size_t found = 0;
    std::size_t wrong = 0;
    std::size_t worst_wrong_inliers = 0;  ///< of candidates accepted or not
};

template <class IsTrue>
Score score_of(const std::vector<FrameRow>& rows, IsTrue&& is_true)
{
    Score score;
    for (const auto& row : rows)
    {
        if (!row.candidate) continue;
        const bool correct = is_true(row.frame, *row.candidate);
        if (row.accepted) ++(correct ? score.found : score.wrong);
        if (!correct) score.worst_wrong_inliers = std::max(score.worst_wrong_inliers, row.inliers);
    }
    return score;
}

class Corridor : public ::testing::Test
{
 protected:
    void SetUp() override
    {
        const auto missing = missing_of(
            {kData + "/corridor/loops.txt", fild::find_model_file("mobilenet_v2_objectron.onnx")});
        if (!missing.empty()) GTEST_SKIP() << missing << " is missing";
        for (const auto& line : lines_of(read_text(kData + "/corridor/loops.txt")))
        {
            std::istringstream words(line);  // a comment has no number to read
            std::size_t query = 0;
            std::size_t match = 0;
            if (words >> query >> match) truth_[query].insert(match);
        }
        ASSERT_EQ(truth_.size(), 44U);
    }

    double recall(const std::string& config) const
    {
        std::string list;
        for (int i = 0; i < 84; ++i)
        {
            const auto number = std::to_string(i);
            const auto name = std::string(4 - number.size(), '0') + number + ".jpg";
            list.append(kData).append("/corridor/images/").append(name).append(" ");
            list.append(number).append("\n");
        }
        const auto rows = run(list, config, "--set index.delay_seconds=20");
        const auto score =
            score_of(rows,
                     [&](std::size_t query, std::size_t candidate)
                     {
                         const auto found = truth_.find(query);
                         return found != truth_.end() && found->second.count(candidate);
                     });
        EXPECT_EQ(score.wrong, 0U);
        return static_cast<double>(score.found) / static_cast<double>(truth_.size());
    }

 private:
    std::map<std::size_t, std::set<std::size_t>> truth_;
};

TEST_F(Corridor, WithThePapersSettings)
{
    EXPECT_GE(recall("fild_paper.ini"), 0.32);
}

TEST_F(Corridor, WithOurSettings)
{
    EXPECT_GE(recall("default.ini"), 0.90);
}

class Kitti03 : public ::testing::Test
{
 protected:
    /** tests/benchmark/accuracy.sh takes all. */
    const std::size_t frames_ = std::getenv("FILD_FULL_TESTS") != nullptr ? 300 : 240;

    struct Position
    {
        double x = 0;
        double y = 0;
        double z = 0;
    };

    void SetUp() override
    {
        const auto missing = missing_of({kData + "/kitti03/poses_kitti.txt",
                                         fild::find_model_file("mobilenet_v2_objectron.onnx")});
        if (!missing.empty()) GTEST_SKIP() << missing << " is missing";
        for (const auto& line : lines_of(read_text(kData + "/kitti03/poses_kitti.txt")))
        {
            std::istringstream words(line);
            double p[12];
            for (auto& number : p) words >> number;
            positions_.push_back({p[3], p[7], p[11]});
        }
        ASSERT_GE(positions_.size(), frames_);
    }

    /** Drives through the frames in this order, at 10 Hz. */
    static std::vector<FrameRow> drive(const std::vector<std::size_t>& order)
    {
        std::string list;
        for (std::size_t i = 0; i < order.size(); ++i)
        {
            const auto number = std::to_string(order[i]);
            const auto name = std::string(6 - number.size(), '0') + number + ".jpg";
            list.append(kData).append("/kitti03/images/").append(name).append(" ");
            list.append(std::to_string(i / 10))
                .append(".")
                .append(std::to_string(i % 10))
                .append("\n");
        }
        return run(list, "default.ini", "--set index.delay_seconds=10");
    }

    double metres_between(std::size_t a, std::size_t b) const
    {
        const auto& p = positions_[a];
        const auto& q = positions_[b];
        return std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) +
                         (p.z - q.z) * (p.z - q.z));
    }

 private:
    std::vector<Position> positions_;
};

TEST_F(Kitti03, DrivenTwiceIsFoundAgainAlmostEverywhere)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < frames_; i += 2) order.push_back(i);
    for (std::size_t i = 1; i < frames_; i += 2) order.push_back(i);
    const auto score = score_of(drive(order),
                                [&](std::size_t query, std::size_t candidate)
                                { return metres_between(order[query], order[candidate]) <= 5; });
    EXPECT_EQ(score.wrong, 0U);
    EXPECT_GE(static_cast<double>(score.found), 0.99 * static_cast<double>(frames_) / 2);
}

TEST_F(Kitti03, DrivenStraightThroughHasNoLoop)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < frames_; ++i) order.push_back(i);
    for (const auto& row : drive(order)) EXPECT_FALSE(row.accepted) << "frame " << row.frame;
}

TEST(TestsRgbd, RunsThrough)
{
    const std::string rawlog = "/usr/share/mrpt/datasets/tests_rgbd.rawlog";
    const auto missing = missing_of({rawlog, fild::find_model_file("mobilenet_v2_objectron.onnx")});
    if (!missing.empty()) GTEST_SKIP() << missing << " is missing";
    const TemporaryFolder folder;
    const auto finished = fild::testing::run_command(
        "'" RAWLOG_LOOP_CLOSURE "' --quiet --rawlog " + rawlog + " --config '" + kConfigs +
        "default.ini' --output '" + folder.path("out") + "'");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_GT(fild::testing::read_frames_csv(folder.path("out/frames.csv")).size(), 0U);
}

}  // namespace
