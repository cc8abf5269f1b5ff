// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/overlap_loops.h"

#include "flat_scene.h"
#include "message_of.h"

#include <sstream>

namespace
{
using fild::CameraModel;
using fild::FrameId;
using fild::LoopPair;
using fild::OverlapLoops;
using fild::TTruthOptions;
using fild::testing::draw_panels;
using fild::testing::Panel;
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;

/** 90 degrees wide and high. */
CameraModel camera()
{
    CameraModel model;
    model.width = model.height = 160;
    model.fx = model.fy = 80;
    model.cx = model.cy = 79.5;
    return model;
}

/** A camera 5 m over the ground that looks along x, turned by a yaw. */
TPose3D at(double x, double y, double yaw_deg = 0)
{
    return (CPose3D(x, y, 5, yaw_deg * M_PI / 180, 0, 0) +
            CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2))
        .asTPose();
}

/** Fills the view of a camera 10 m before it, and no more: 20 m x 20 m, 10 m over the ground. */
Panel filling_wall(double x = 10)
{
    return {{x, 0, 5}, {0, 10, 0}, {0, 0, 10}};
}

/** Larger than any view of it. */
Panel wide_wall(double x)
{
    return {{x, 0, 5}, {0, 200, 0}, {0, 0, 200}};
}

/** Any overlap counts. */
TTruthOptions lenient()
{
    TTruthOptions options;
    options.overlap = 0.01;
    return options;
}

/** What the truth says of some frames. */
struct Verdicts
{
    std::vector<LoopPair> loops;
    std::vector<LoopPair> doubtful;
};

/** The verdicts on frames 30 s apart. */
Verdicts verdicts(const TTruthOptions& options,
                  const std::vector<Panel>& panels,
                  const std::vector<TPose3D>& poses)
{
    OverlapLoops truth(options, camera());
    double seconds = 0;
    for (const auto& pose : poses)
    {
        truth.add(seconds, pose, draw_panels(panels, camera(), CPose3D(pose)).depth);
        seconds += 30;
    }
    return {truth.pairs(), truth.doubtful_pairs()};
}

std::vector<LoopPair> loops(const TTruthOptions& options,
                            const std::vector<Panel>& panels,
                            const std::vector<TPose3D>& poses)
{
    return verdicts(options, panels, poses).loops;
}

/** "right", "doubtful" or "wrong": the default truth about two frames. */
std::string verdict(const std::vector<Panel>& panels,
                    const TPose3D& first,
                    const TPose3D& second,
                    const TTruthOptions& options = {})
{
    const auto found = verdicts(options, panels, {first, second});
    EXPECT_LE(found.loops.size() + found.doubtful.size(), 1U);
    if (!found.loops.empty()) return "right";
    return found.doubtful.empty() ? "wrong" : "doubtful";
}

/** The overlap of the second frame with the first; 0: no loop. */
double overlap(const std::vector<Panel>& panels, const TPose3D& first, const TPose3D& second)
{
    const auto pairs = loops(lenient(), panels, {first, second});
    return pairs.empty() ? 0 : pairs.front().overlap;
}

TEST(OverlapLoops, TheSamePoseSeesAll)
{
    EXPECT_DOUBLE_EQ(overlap({filling_wall()}, at(0, 0), at(0, 0)), 1);
}

TEST(OverlapLoops, SeesTheShareOfAWallThatIsStillInTheImage)
{
    // 20 m of wall are seen from 10 m; a camera 5 m to the left sees 15 m of them still.
    const Panel wide = wide_wall(10);
    EXPECT_NEAR(overlap({wide}, at(0, 0), at(0, 5)), 0.75, 0.03);
    EXPECT_NEAR(overlap({wide}, at(0, 0), at(0, -8)), 0.6, 0.03);
    // From 8 m it sees 16 m x 16 m of 20 m x 20 m, all of which are in the view from 10 m.
    EXPECT_NEAR(overlap({wide}, at(0, 0), at(2, 0)), 1, 0.001);
    EXPECT_NEAR(overlap({wide}, at(2, 0), at(0, 0)), 1, 0.001);
}

TEST(OverlapLoops, SeesNothingThroughAnOccluder)
{
    // Seen from (0, 0) only the wall; the board hides half of it from (0, 4), which it stands
    // before: y > 4 of the wall, as seen from there, and beyond the first camera's image.
    const Panel wide = wide_wall(10);
    const Panel board{{6, 14, 5}, {0, 10, 0}, {0, 0, 50}};
    const double without = overlap({wide}, at(0, 0), at(0, 4));
    const double with = overlap({wide, board}, at(0, 0), at(0, 4));
    EXPECT_NEAR(without, 0.8, 0.03);
    EXPECT_LT(with, without);
    // The first camera sees y in [-10, 10] of the wall, from y = 4 * 10 / 6 = 6.7 on the board.
    // The second sees the wall for y in [-6, 4] of that, and the board's y in [4, 10].
    const double board_from = 4;
    const double wall_seen = board_from + 6;  // m of the wall that both see
    const double board_share = (1 - board_from / 6) / 2;  // of the first image
    EXPECT_NEAR(with, wall_seen / 20 + board_share, 0.04);
}

TEST(OverlapLoops, AWallBetweenTheCamerasHidesAll)
{
    const Panel far_wall = wide_wall(30);
    const Panel near_wall = wide_wall(2);
    EXPECT_EQ(overlap({far_wall, near_wall}, at(3, 0), at(0, 0)), 0);
}

TEST(OverlapLoops, DoesNotCountTheSky)
{
    // The wall fills a quarter of the first view; of that all is seen.
    Panel small = filling_wall();
    small.half_width *= 0.5;
    small.half_height *= 0.5;
    EXPECT_NEAR(overlap({small}, at(0, 0), at(0, 2)), 1, 0.001);
    EXPECT_NEAR(overlap({small}, at(0, 0), at(-3, 0)), 1, 0.001);
}

TEST(OverlapLoops, NothingButSkyIsNoLoop)
{
    EXPECT_TRUE(loops(lenient(), {}, {at(0, 0), at(0, 0)}).empty());
}

TEST(OverlapLoops, SeesGroundAtAFlatAngle)
{
    const Panel ground{{0, 0, 3.4}, {500, 0, 0}, {0, 500, 0}};
    EXPECT_GT(overlap({ground}, at(0, 0), at(-1, 0)), 0.97);
    EXPECT_GT(overlap({ground}, at(0, 0), at(-1, 0.7, 1)), 0.97);
}

TEST(OverlapLoops, TheOppositeDirectionIsNoLoop)
{
    const std::vector<Panel> panels{filling_wall(10), filling_wall(-10)};
    EXPECT_EQ(overlap(panels, at(0, 0), at(0, 0, 180)), 0);
    auto options = lenient();
    options.max_angle_deg = 180;
    EXPECT_TRUE(loops(options, panels, {at(0, 0), at(0, 0, 180)}).empty());
}

TEST(OverlapLoops, KeepsToItsLimits)
{
    const Panel wide = wide_wall(40);
    EXPECT_GT(overlap({wide}, at(0, 0), at(0, 9.9)), 0);
    EXPECT_EQ(overlap({wide}, at(0, 0), at(0, 10.1)), 0);
    EXPECT_GT(overlap({wide}, at(0, 0), at(0, 0, 44)), 0);
    EXPECT_EQ(overlap({wide}, at(0, 0), at(0, 0, 46)), 0);
    auto options = lenient();
    options.min_age_seconds = 30;
    EXPECT_FALSE(loops(options, {wide}, {at(0, 0), at(0, 0)}).empty());
    options.min_age_seconds = 30.5;
    EXPECT_TRUE(loops(options, {wide}, {at(0, 0), at(0, 0)}).empty());
    options = lenient();
    options.overlap = 0.8;
    EXPECT_TRUE(loops(options, {wide}, {at(0, 0), at(0, 0, 30)}).empty());
}

TEST(OverlapLoops, NearFramesThatAreNoLoopAreDoubtful)
{
    // Two rooms that share nothing: a wall stands between the cameras and before both.
    const std::vector<Panel> rooms{{{12, 5, 5}, {0, 5, 0}, {0, 0, 200}},
                                   {{3, 15, 5}, {0, 5, 0}, {0, 0, 200}},
                                   {{0, 10, 5}, {200, 0, 0}, {0, 0, 200}}};
    EXPECT_EQ(verdict(rooms, at(0, 5), at(0, 14)), "doubtful");
    EXPECT_EQ(verdict(rooms, at(0, 0), at(0, 14.9)), "doubtful");
    EXPECT_EQ(verdict(rooms, at(0, 0), at(0, 15.1)), "wrong");
    const Panel sky_only{{0, 0, -500}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(verdict({sky_only}, at(0, 0), at(0, 0, 59)), "doubtful");
    EXPECT_EQ(verdict({sky_only}, at(0, 0), at(0, 0, 61)), "wrong");
}

TEST(OverlapLoops, FarFramesThatShowTheSameSurfaceAreDoubtful)
{
    const Panel wide = wide_wall(40);
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 20)), "doubtful");
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 39)), "doubtful");
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 41)), "doubtful");
    auto nearer = TTruthOptions();
    nearer.doubtful_overlap_distance_m = 40;
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 39), nearer), "doubtful");
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 41), nearer), "wrong");
    // 90 degrees wide: turned by 80 degrees, they share the far end of a wall at most.
    const Panel slanted{{40, 0, 5}, {100, -100, 0}, {0, 0, 200}};
    EXPECT_EQ(verdict({slanted}, at(0, 0), at(0, 0, 80)), "doubtful");
    auto options = TTruthOptions();
    options.doubtful_overlap_angle_deg = 79;
    EXPECT_EQ(verdict({slanted}, at(0, 0), at(0, 0, 80), options), "wrong");
    options = TTruthOptions();
    options.doubtful_overlap_distance_m = 19;
    EXPECT_EQ(verdict({wide}, at(0, 0), at(0, 20), options), "wrong");
}

TEST(OverlapLoops, SharedSurfaceCountsInEitherDirection)
{
    // From 30 m before the wall its middle 4 m are all that the nearer camera sees: 1/15 x 1/15 of
    // the farther image, but all of the nearer one.
    const Panel wall = wide_wall(32);
    EXPECT_EQ(verdict({wall}, at(0, 0), at(30, 0)), "doubtful");
    EXPECT_EQ(verdict({wall}, at(30, 0), at(0, 0)), "doubtful");
    auto options = TTruthOptions();
    options.doubtful_overlap = 0.01;
    EXPECT_EQ(verdict({wall, wide_wall(1)}, at(0, 0), at(30, 0), options), "wrong");
}

TEST(OverlapLoops, LooksNowhereForYoungPairs)
{
    TTruthOptions options;
    options.min_age_seconds = 31;
    const auto found =
        verdicts(options, {wide_wall(40)}, {at(0, 0), at(0, 0), at(0, 20), at(0, 12)});
    ASSERT_EQ(found.loops.size() + found.doubtful.size(), 3U);  // 2-0, 3-0, 3-1
    for (const auto& pair : found.doubtful)
        EXPECT_GE(to_index(pair.query) - to_index(pair.candidate), 2U);
}

TEST(OverlapLoops, TakesImagesOfFewRows)
{
    for (const int rows : {2, 3, 6})
    {
        auto flat = camera();
        flat.height = rows;
        flat.cy = (rows - 1) / 2.0;
        OverlapLoops truth(TTruthOptions(), flat);
        const cv::Mat depth(rows, 160, CV_32FC1, cv::Scalar(20));
        truth.add(0, at(0, 0), depth);
        truth.add(30, at(0, 37), depth);
        truth.add(60, at(0, 18), depth);
        EXPECT_EQ(truth.doubtful_pairs().size(), rows < 3 ? 0U : 3U) << rows;
    }
}

TEST(OverlapLoops, FindsAllPairsInOrder)
{
    const auto pairs = loops(lenient(), {filling_wall()}, {at(0, 0), at(0, 1), at(0, 0), at(0, 2)});
    std::ostringstream found;
    for (const auto& pair : pairs)
        found << to_index(pair.query) << "-" << to_index(pair.candidate) << " ";
    EXPECT_EQ(found.str(), "1-0 2-0 2-1 3-0 3-1 3-2 ");
}

TEST(OverlapLoops, RefusesDepthThatIsNotTheCameras)
{
    OverlapLoops truth(lenient(), camera());
    EXPECT_THROW(truth.add(0, at(0, 0), cv::Mat(160, 159, CV_32FC1)), std::invalid_argument);
    EXPECT_THROW(truth.add(0, at(0, 0), cv::Mat(160, 160, CV_16UC1)), std::invalid_argument);
    EXPECT_THROW(truth.add(0, at(0, 0), cv::Mat()), std::invalid_argument);
}

TEST(OverlapLoops, RefusesBadOptions)
{
    auto options = lenient();
    options.overlap = 0;
    EXPECT_THROW(OverlapLoops(options, camera()), std::invalid_argument);
    auto lens = camera();
    lens.lens = fild::LensModel::plumb_bob;
    EXPECT_THROW(OverlapLoops(lenient(), lens), std::invalid_argument);
}

TEST(WriteLoops, WritesAHeaderAndALineAPair)
{
    std::ostringstream out;
    write_loops(out,
                TTruthOptions(),
                {{FrameId{7}, FrameId{1}, 0.5}, {FrameId{8}, FrameId{0}, 1}},
                {{FrameId{7}, FrameId{2}, 0.3}});
    std::istringstream lines(out.str());
    std::string line;
    std::string header;
    while (std::getline(lines, line) && line[0] == '#') header += line;
    EXPECT_THAT(header, HasSubstr("overlap=0.4"));
    EXPECT_THAT(header, HasSubstr("min_age_seconds=20"));
    EXPECT_THAT(header, HasSubstr("doubtful_max_distance_m=15"));
    EXPECT_THAT(header, HasSubstr("without a line"));
    EXPECT_EQ(line, "7 1");
    std::getline(lines, line);
    EXPECT_EQ(line, "8 0");
    std::getline(lines, line);
    EXPECT_EQ(line, "7 2 0");
    EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
