// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/map_scene.h"

#include "fild/render/offscreen_renderer.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace
{
using fild::DrawnMap;
using fild::FrameId;
using fild::MapPicture;
using fild::MapScene;
using fild::PlacedFrame;

// BGR, as in the legend.
const cv::Scalar kPath(35, 40, 45);
const cv::Scalar kBefore(233, 180, 86);
const cv::Scalar kTruthBand(120, 205, 250);
const cv::Scalar kTruthLine(0, 159, 230);
const cv::Scalar kRejected(238, 225, 243);  // half a pixel wide
const cv::Scalar kUnused(150, 40, 205);
const cv::Scalar kWeakest(121, 43, 72);
const cv::Scalar kStrongest(36, 222, 200);
const cv::Scalar kStart(178, 114, 0);
const cv::Scalar kEnd(0, 94, 213);

/** A way round a rectangle, 200 m to the east and 100 m to the north, a frame every 10 m; frame
 *  i of the second round is where frame i - 60 was. */
std::vector<PlacedFrame> two_rounds(const cv::Vec3d& corner = {0, 0, 0})
{
    std::vector<PlacedFrame> frames;
    for (std::size_t i = 0; i < 120; ++i)
    {
        const double along = 10 * static_cast<double>(i % 60);
        const auto position = along < 200   ? cv::Vec3d(along, 0, 0)
                              : along < 300 ? cv::Vec3d(200, along - 200, 0)
                              : along < 500 ? cv::Vec3d(500 - along, 100, 0)
                                            : cv::Vec3d(0, 600 - along, 0);
        frames.push_back({FrameId{i}, {cv::Matx33d::eye(), corner + position}});
    }
    return frames;
}

DrawnMap map_of(const std::vector<PlacedFrame>& frames)
{
    DrawnMap map;
    map.optimized = frames;
    return map;
}

/** How many pixels are about of the colour, of the few around a place. */
int coloured(const MapPicture& picture,
             const cv::Vec3d& place,
             const cv::Scalar& colour,
             int radius = 4)
{
    const auto pixel = picture.project(place);
    const cv::Rect all({0, 0}, picture.image.size());
    const cv::Rect around(
        cvRound(pixel.x) - radius, cvRound(pixel.y) - radius, 2 * radius + 1, 2 * radius + 1);
    EXPECT_EQ(around & all, around) << "the place is in the picture";
    const auto tolerance = cv::Scalar::all(14);
    cv::Mat found;
    cv::inRange(picture.image(around & all), colour - tolerance, colour + tolerance, found);
    return cv::countNonZero(found);
}

std::array<MapPicture, 2> both_pictures(const DrawnMap& map)
{
    const MapScene scene(map, {});
    return {scene.draw_from_above(), scene.draw_in_perspective()};
}

/** A camera at the middle of the map, with an image of one colour. */
fild::DrawnCamera camera_to_the_north()
{
    fild::DrawnCamera drawn;
    drawn.camera.fx = drawn.camera.fy = 100;
    drawn.camera.cx = 80;
    drawn.camera.cy = 60;
    drawn.camera.width = 160;
    drawn.camera.height = 120;
    drawn.image = cv::Mat(120, 160, CV_8UC3, cv::Scalar(255, 0, 255));
    drawn.map_from_camera = {{1, 0, 0, 0, 0, 1, 0, -1, 0}, {100, 40, 1}};
    return drawn;
}

TEST(MapScene, ShowsTheWholeWay)
{
    for (const auto& picture : both_pictures(map_of(two_rounds())))
    {
        ASSERT_EQ(picture.image.size(), cv::Size(1600, 1000));
        for (const auto& place : {cv::Vec3d(105, 0, 0), {200, 55, 0}, {95, 100, 0}, {0, 45, 0}})
            EXPECT_GT(coloured(picture, place, kPath), 4) << place;
        EXPECT_EQ(coloured(picture, {100, 50, 0}, kPath), 0) << "none in the middle";
    }
}

TEST(MapScene, FillsThePictureWithNorthUp)
{
    const auto picture = MapScene(map_of(two_rounds()), {}).draw_from_above();
    const auto south_west = picture.project({0, 0, 0});
    const auto north_east = picture.project({200, 100, 0});
    EXPECT_GT(north_east.x - south_west.x, 900);
    EXPECT_NEAR((south_west.y - north_east.y) / (north_east.x - south_west.x), 0.5, 0.005);
}

TEST(MapScene, TurnsWhatIsTall)
{
    std::vector<PlacedFrame> northwards;
    for (std::size_t i = 0; i < 30; ++i)
        northwards.push_back(
            {FrameId{i}, {cv::Matx33d::eye(), {0, 10 * static_cast<double>(i), 0}}});
    const auto picture = MapScene(map_of(northwards), {}).draw_from_above();
    const auto along = picture.project({0, 290, 0}) - picture.project({0, 0, 0});
    EXPECT_LT(along.x, -700) << "x is up, y to the left";
    EXPECT_NEAR(along.y, 0, 1);
}

TEST(MapScene, MarksStartAndEnd)
{
    auto frames = two_rounds();
    frames.resize(90);
    for (const auto& picture : both_pictures(map_of(frames)))
    {
        EXPECT_GT(coloured(picture, {0, 0, 0}, kStart), 20);
        EXPECT_GT(coloured(picture, {200, 90, 0}, kEnd), 20);
    }
}

TEST(MapScene, ShowsTheWayBeforeAndInTruth)
{
    auto map = map_of(two_rounds());
    map.input = two_rounds({0, 8, 0});
    for (double x = 0; x <= 200; x += 10) map.ground_truth.emplace_back(x, -9, 0);
    const auto [above, aslant] = both_pictures(map);
    for (const auto& picture : {above, aslant})
        EXPECT_GT(coloured(picture, {105, 8, 0}, kBefore), 8);
    EXPECT_GT(coloured(above, {105, -9, 0}, kTruthBand), 30);
    EXPECT_GT(coloured(aslant, {105, -9, 0}, kTruthLine), 2);
}

TEST(MapScene, JoinsNoSegments)
{
    auto map = map_of(two_rounds());
    for (auto& frame : map.optimized) frame.segment = frame.frame < FrameId{15} ? 0 : 1;
    map.optimized.resize(30);
    const auto picture = MapScene(map, {}).draw_from_above();
    EXPECT_GT(coloured(picture, {135, 0, 0}, kPath), 8);
    EXPECT_EQ(coloured(picture, {145, 0, 0}, kPath), 0) << "between frames 14 and 15";
    EXPECT_GT(coloured(picture, {155, 0, 0}, kPath), 8);
}

TEST(MapScene, ColoursLoopsByInliers)
{
    auto map = map_of(two_rounds());
    map.loops = {{FrameId{65}, FrameId{5}, 20, 1},
                 {FrameId{75}, FrameId{15}, 500, 1},
                 {FrameId{100}, FrameId{40}, 500, 0},
                 {FrameId{4000}, FrameId{50}, 500, 1}};
    for (const auto& picture : both_pictures(map))
    {
        EXPECT_GT(coloured(picture, {50, 0, 0}, kWeakest), 8);
        EXPECT_GT(coloured(picture, {150, 0, 0}, kStrongest), 8);
        EXPECT_GT(coloured(picture, {100, 100, 0}, kUnused), 8) << "has no weight";
        EXPECT_EQ(coloured(picture, {0, 100, 0}, kStrongest), 0) << "its query has no place";
    }
}

TEST(MapScene, ColoursLoopsByTheTruthAboutThem)
{
    using Mark = fild::LoopTruthMark;
    auto map = map_of(two_rounds());
    map.loops = {{FrameId{65}, FrameId{5}, 20, 1, Mark::right},
                 {FrameId{75}, FrameId{15}, 500, 0, Mark::wrong},
                 {FrameId{100}, FrameId{40}, 500, 1, Mark::doubtful}};
    map.missed = {FrameId{110}};
    for (const auto& picture : both_pictures(map))
    {
        EXPECT_GT(coloured(picture, {50, 0, 0}, {115, 158, 0}), 8) << "right: green";
        EXPECT_GT(coloured(picture, {150, 0, 0}, {20, 20, 220}), 8) << "wrong: red, used or not";
        EXPECT_GT(coloured(picture, {100, 100, 0}, {200, 107, 138}), 8);
        EXPECT_GT(coloured(picture, {0, 100, 0}, cv::Scalar::all(255), 2), 4) << "a ring";
    }
}

/** How far the dark pixels reach to the sides of the way at each pixel along a stretch. */
std::vector<int> widths_along(const MapPicture& picture, const cv::Vec3d& from, const cv::Vec3d& to)
{
    const auto first = picture.project(from);
    const auto last = picture.project(to);
    const auto pixels = static_cast<int>(cv::norm(last - first));
    const auto along = (last - first) * (1.0 / pixels);
    const cv::Point2d aside(-along.y, along.x);
    std::vector<int> widths;
    for (int i = 0; i < pixels; ++i)
    {
        int dark = 0;
        for (int k = -15; k <= 15; ++k)
        {
            const cv::Point at(first + i * along + k * aside);
            if (picture.image.at<cv::Vec3b>(at)[0] < 90) ++dark;
        }
        widths.push_back(dark);
    }
    return widths;
}

TEST(MapScene, PointsTheWayThatWasDriven)
{
    auto frames = two_rounds();
    frames.resize(60);
    const auto picture = MapScene(map_of(frames), {}).draw_from_above();
    for (const auto& [from, to] :
         {std::pair<cv::Vec3d, cv::Vec3d>{{12, 0, 0}, {188, 0, 0}}, {{188, 100, 0}, {12, 100, 0}}})
    {
        const auto widths = widths_along(picture, from, to);
        const auto widest = std::max_element(widths.begin(), widths.end());
        ASSERT_GT(*widest, 10);
        ASSERT_GT(widest - widths.begin(), 4);
        ASSERT_GT(widths.end() - widest, 20);
        EXPECT_LT(*(widest - 4), *widest / 2) << "an arrowhead begins with its full width";
        EXPECT_GT(*(widest + 5), *widest / 2) << "and grows thin";
    }
}

TEST(MapScene, ShowsFromAboveWhereCamerasLook)
{
    auto map = map_of(two_rounds());
    auto camera = camera_to_the_north();
    camera.image.release();
    camera.map_from_camera.translation = {105, 43, 1};  // beside the lines of the grid
    map.cameras = {camera};
    const auto& place = camera.map_from_camera.translation;
    const auto nearly_grey = [&](const cv::Vec3d& at)
    {
        const auto picture = MapScene(map, {}).draw_from_above();
        const auto pixel = picture.project(at);
        cv::Mat found;
        cv::inRange(picture.image(cv::Rect(cv::Point(pixel) - cv::Point(3, 3), cv::Size(7, 7))),
                    cv::Scalar::all(0),
                    cv::Scalar::all(215),
                    found);
        return cv::countNonZero(found);
    };
    // 6 % of 230 m wide: the frustum reached as far to the sides as ahead.
    EXPECT_GT(nearly_grey(place + cv::Vec3d(0, 3, 0)), 2) << "a line ahead";
    EXPECT_EQ(nearly_grey(place + cv::Vec3d(0, -3, 0)), 0) << "nothing behind";
}

TEST(MapScene, ColoursLoopsByWeight)
{
    auto map = map_of(two_rounds());
    map.loops = {{FrameId{65}, FrameId{5}, 500, 0.001}, {FrameId{75}, FrameId{15}, 20, 1}};
    fild::TRenderOptions options;
    options.loop_colour = fild::LoopColour::weight;
    const auto picture = MapScene(map, options).draw_from_above();
    EXPECT_GT(coloured(picture, {50, 0, 0}, kWeakest), 8);
    EXPECT_GT(coloured(picture, {150, 0, 0}, kStrongest), 8);
}

/** A way that climbs by 20 m, pairs across it: what is higher must hide nothing. */
TEST(MapScene, RejectedPairsHideNoWay)
{
    auto map = map_of(two_rounds());
    for (std::size_t i = 0; i < map.optimized.size(); ++i)
        map.optimized[i].map_from_robot.translation[2] = static_cast<double>(i) / 6;
    const auto bare = both_pictures(map);
    for (std::size_t i = 0; i < 40; ++i)
        map.rejected.emplace_back(FrameId{119 - i}, FrameId{5 + 2 * i});
    const auto drawn = both_pictures(map);
    EXPECT_GT(coloured(drawn[0], {90, 50, 0}, kRejected, 40), 20);
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i + 1 < map.optimized.size(); ++i)
        {
            const auto& a = map.optimized[i].map_from_robot.translation;
            const auto& b = map.optimized[i + 1].map_from_robot.translation;
            EXPECT_GE(coloured(drawn[k], (a + b) / 2, kPath) + 6,
                      coloured(bare[k], (a + b) / 2, kPath))
                << "picture " << k << ", frame " << i;
        }
}

TEST(MapScene, IsTheSameFarFromTheOrigin)
{
    const cv::Vec3d utm(500000, 4000000, 300);
    const auto near = both_pictures(map_of(two_rounds()));
    const auto far = both_pictures(map_of(two_rounds(utm)));
    for (std::size_t k = 0; k < near.size(); ++k)
        for (const auto& place : {cv::Vec3d(105, 0, 0), {200, 55, 0}, {95, 100, 0}})
        {
            EXPECT_LT(cv::norm(near[k].project(place) - far[k].project(place + utm)), 1);
            EXPECT_GT(coloured(far[k], place + utm, kPath), 4);
        }
}

TEST(MapScene, BearsASingleFrameAndAShaft)
{
    std::vector<PlacedFrame> shaft;
    for (std::size_t i = 0; i < 20; ++i)
        shaft.push_back({FrameId{i}, {cv::Matx33d::eye(), {0, 0, 3 * static_cast<double>(i)}}});
    for (const auto& frames : {shaft, {shaft.front()}})
        for (const auto& picture : both_pictures(map_of(frames)))
            EXPECT_GT(coloured(picture, frames.back().map_from_robot.translation, kEnd), 20);
}

TEST(MapScene, StandsImagesInTheirFrusta)
{
    auto map = map_of(two_rounds());
    map.cameras = {camera_to_the_north()};
    const auto picture = MapScene(map, {}).draw_in_perspective();
    EXPECT_GT(coloured(picture, {100, 48, 1}, {255, 0, 255}), 60);
}

/** What MRPT's own viewer shows of a stored scene, with its light and its reach. */
cv::Mat seen_by_a_viewer(const std::string& path, const fild::PictureView& view)
{
    auto scene = mrpt::opengl::COpenGLScene::Create();
    EXPECT_TRUE(scene->loadFromFile(path));
    fild::OffscreenRenderer renderer(scene, {0.01, 10000});
    const auto& pose = view.map_from_camera;
    mrpt::math::CMatrixDouble33 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation(row, column) = pose.rotation(row, column);
    const auto& t = pose.translation;
    return renderer.draw_image(view.camera,
                               {rotation, mrpt::math::CVectorFixedDouble<3>({t[0], t[1], t[2]})});
}

TEST(MapScene, LooksTheSameInAViewer)
{
    const fild::testing::TemporaryFolder folder;
    auto map = map_of(two_rounds());
    map.input = two_rounds({0, 8, 0});
    map.loops = {{FrameId{65}, FrameId{5}, 20, 1}, {FrameId{75}, FrameId{15}, 500, 1}};
    map.cameras = {camera_to_the_north()};
    map.cameras.front().image.rowRange(0, 60) = cv::Scalar(0, 255, 255);
    const MapScene drawn(map, {});
    drawn.save(folder.path("map.3Dscene"));
    const auto view = drawn.draw_in_perspective().view;
    const MapPicture seen{seen_by_a_viewer(folder.path("map.3Dscene"), view), view};
    EXPECT_GT(coloured(seen, {105, 0, 2}, kPath), 4);
    EXPECT_GT(coloured(seen, {105, 8, 2}, kBefore), 4);
    EXPECT_GT(coloured(seen, {50, 0, 2}, kWeakest, 6), 8);
    EXPECT_GT(coloured(seen, {150, 0, 2}, kStrongest, 6), 8);
    EXPECT_GT(coloured(seen, {100, 48, 3}, {0, 255, 255}), 40) << "the upper half of the image";
    EXPECT_GT(coloured(seen, {100, 48, -1}, {255, 0, 255}), 40) << "and the lower one";
}

TEST(MapScene, HasTheSameBytesAgain)
{
    const auto map = map_of(two_rounds());
    const auto once = both_pictures(map);
    const auto again = both_pictures(map);
    for (std::size_t k = 0; k < once.size(); ++k)
        EXPECT_EQ(cv::norm(once[k].image, again[k].image, cv::NORM_INF), 0);
}

TEST(MapScene, HasTheSizeThatIsAsked)
{
    fild::TRenderOptions options;
    options.map_picture_width_px = 640;
    options.map_picture_height_px = 480;
    const MapScene scene(map_of(two_rounds()), options);
    EXPECT_EQ(scene.draw_from_above().image.size(), cv::Size(640, 480));
    EXPECT_GT(coloured(scene.draw_in_perspective(), {105, 0, 0}, kPath), 1);
}

TEST(MapScene, IsReadByMrpt)
{
    const fild::testing::TemporaryFolder folder;
    auto map = map_of(two_rounds());
    map.input = two_rounds({0, 8, 0});
    map.loops = {{FrameId{65}, FrameId{5}, 20, 1}};
    map.rejected = {{FrameId{70}, FrameId{40}}};
    const MapScene drawn(map, {});
    drawn.save(folder.path("map.3Dscene"));
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(folder.path("map.3Dscene")));
    for (const auto* name : {"grid",
                             "optimised path",
                             "path before the loops",
                             "loops",
                             "rejected pairs",
                             "start",
                             "end"})
        EXPECT_TRUE(scene.getByName(name)) << name;
    EXPECT_FALSE(scene.getByName("ground truth")) << "none is given";
    const auto box = scene.getByName("optimised path")->getBoundingBox();
    EXPECT_NEAR(box.max.x - box.min.x, 200, 2) << "metres";
    EXPECT_THROW(drawn.save(folder.path("none/map.3Dscene")), std::runtime_error);
}

TEST(MapScene, RefusesWhatCannotBeDrawn)
{
    EXPECT_THROW(MapScene({}, {}), std::invalid_argument);
    auto map = map_of(two_rounds());
    map.optimized[3].map_from_robot.translation[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(MapScene(map, {}), std::invalid_argument);
}

}  // namespace
