// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/surf.h"
#include "fild/synthetic/birds_eye.h"
#include "fild/synthetic/synthetic_options.h"
#include "fild/synthetic/town.h"
#include "message_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace
{
fild::TTownOptions one_block()
{
    fild::TTownOptions options;
    options.columns = 1;
    options.rows = 1;
    options.block_length_m = 40;
    options.block_width_m = 40;
    return options;
}

fild::CameraModel camera(int width = 640, int height = 480)
{
    fild::CameraModel model;
    model.width = width;
    model.height = height;
    model.fx = model.fy = 0.66 * width;
    model.cx = (width - 1) / 2.0;
    model.cy = (height - 1) / 2.0;
    return model;
}

/** A camera 1.5 m over the road that looks along its heading. */
mrpt::poses::CPose3D on_the_road(double x, double y, double heading)
{
    return mrpt::poses::CPose3D(x, y, 1.5, heading, 0, 0) +
           mrpt::poses::CPose3D(0, 0, 0, -CV_PI / 2, 0, -CV_PI / 2);
}

double difference(const cv::Mat& a, const cv::Mat& b)
{
    return cv::norm(a, b, cv::NORM_L1) / (static_cast<double>(a.total()) * a.channels());
}

TEST(Town, HasEnoughDetailForLocalFeatures)
{
    fild::Town town(one_block());
    const fild::SurfExtractor surf(fild::TLocalFeatureOptions{});
    std::size_t keypoints = 0;
    constexpr int kViews = 8;
    for (int i = 0; i < kViews; ++i)
    {
        const auto view =
            town.draw(camera(), on_the_road(6 + 5 * i, -1.75, 0.05 * (i % 3 - 1)), {});
        cv::Mat grey;
        cv::cvtColor(view.image, grey, cv::COLOR_BGR2GRAY);
        keypoints += surf.extract(grey).size();
    }
    EXPECT_GT(keypoints / kViews, 500U);
}

TEST(Town, TheRoadIsLevelAndTheSkyHasNoDepth)
{
    fild::Town town(one_block());
    const auto model = camera();
    const auto view = town.draw(model, on_the_road(5, 0, 0), {});
    for (const int row : {300, 360, 479})
    {
        const auto expected = model.fy * 1.5 / (row - model.cy);
        EXPECT_NEAR(view.depth.at<float>(row, 320), expected, 0.003 * expected) << row;
    }
    EXPECT_EQ(view.depth.at<float>(0, 320), 0);
}

TEST(Town, TheSameSeedGivesTheSamePixels)
{
    const auto view_of = [](int seed)
    {
        auto options = one_block();
        options.seed = seed;
        fild::Town town(options);
        return town.draw(camera(320, 240), on_the_road(5, -1.75, 0), {}).image;
    };
    const auto first = view_of(1);
    EXPECT_EQ(difference(first, view_of(1)), 0);
    EXPECT_GT(difference(first, view_of(2)), 10);
}

TEST(Town, LapsDifferInLightShadowsAndCarsOnly)
{
    fild::Town town(one_block());
    const auto pose = on_the_road(5, -1.75, 0);
    const auto model = camera(320, 240);
    const fild::LapConditions usual;
    const auto reference = town.draw(model, pose, usual).image;
    auto conditions = usual;
    conditions.exposure = 0.7;
    const auto dark = town.draw(model, pose, conditions).image;
    EXPECT_NEAR(cv::mean(dark)[1] / cv::mean(reference)[1], 0.7, 0.01);
    conditions = usual;
    conditions.sun_azimuth = 4;
    EXPECT_GT(difference(town.draw(model, pose, conditions).image, reference), 2);
    conditions = usual;
    conditions.parked_cars = 99;
    EXPECT_GT(difference(town.draw(model, pose, conditions).image, reference), 1);
    EXPECT_EQ(difference(town.draw(model, pose, usual).image, reference), 0);
}

TEST(Town, SeasonsChangeTreesAndGround)
{
    fild::Town town(one_block());
    const auto pose = on_the_road(5, -1.75, 0);
    const auto model = camera(320, 240);
    const auto summer = town.draw(model, pose, {});
    fild::LapConditions conditions;
    conditions.season = 0.8;
    const auto autumn = town.draw(model, pose, conditions);
    EXPECT_GT(difference(autumn.image, summer.image), 2);
    EXPECT_EQ(difference(town.draw(model, pose, {}).image, summer.image), 0);
}

/** Share of the pixels at which a view is nearer than another one. */
double hidden_share(const fild::RenderedView& view, const fild::RenderedView& without)
{
    const cv::Mat nearer = (view.depth > 0) & ((without.depth == 0) | (view.depth < without.depth));
    return static_cast<double>(cv::countNonZero(nearer)) / static_cast<double>(nearer.total());
}

TEST(Town, RoadUsersHideWhatIsBehindThem)
{
    using fild::RoadUserKind;
    fild::Town town(one_block());
    const auto pose = on_the_road(5, -1.75, 0);
    const auto model = camera();
    const auto empty = town.draw(model, pose, {});
    const auto view_with = [&](const fild::RoadUser& user)
    {
        fild::LapConditions conditions;
        conditions.road_users = {user};
        return town.draw(model, pose, conditions);
    };
    // 4 m before the camera.
    const auto lorry = view_with({RoadUserKind::lorry, 9 + 3.25, -1.75, 0, 0, 5});
    EXPECT_GT(hidden_share(lorry, empty), 0.15);
    EXPECT_LT(hidden_share(lorry, empty), 0.4);
    EXPECT_NEAR(lorry.depth.at<float>(240, 320), 4, 0.1);
    // Beside the camera, oncoming.
    const auto bus = view_with({RoadUserKind::bus, 10, 1.4, CV_PI, 0, 5});
    EXPECT_GT(hidden_share(bus, empty), 0.15);
    const auto car = view_with({RoadUserKind::car, 12, -1.75, 0, 0, 5});
    EXPECT_GT(hidden_share(car, empty), 0.03);
    const auto person = view_with({RoadUserKind::pedestrian, 9, -1.75, 0.5, 0.2, 5});
    EXPECT_GT(hidden_share(person, empty), 0.01);
    EXPECT_LT(hidden_share(person, empty), 0.1);
    EXPECT_NEAR(person.depth.at<float>(300, 320), 4, 0.3);
    EXPECT_EQ(difference(town.draw(model, pose, {}).image, empty.image), 0);
}

TEST(Town, RoadUsersStayWhenTheLightChanges)
{
    fild::Town town(one_block());
    const auto pose = on_the_road(5, -1.75, 0);
    const auto model = camera(320, 240);
    fild::LapConditions conditions;
    conditions.road_users = {{fild::RoadUserKind::lorry, 12, -1.75, 0, 0, 5}};
    const auto before = town.draw(model, pose, conditions);
    auto evening = conditions;
    evening.sun_azimuth = 4;
    EXPECT_EQ(hidden_share(town.draw(model, pose, evening), before), 0);
    EXPECT_EQ(difference(town.draw(model, pose, conditions).image, before.image), 0);
}

TEST(Town, RefusesOptionsOutOfRange)
{
    auto options = one_block();
    options.columns = 0;
    EXPECT_THAT(fild::testing::message_of<std::invalid_argument>([&] { fild::Town town(options); }),
                ::testing::HasSubstr("columns"));
}

TEST(BirdsEye, ShowsTheRouteOverTheStreets)
{
    fild::Town town(one_block());
    const fild::RouteLine route{"lap 1", {{0, 0, 0}, {54, 0, 0}, {54, 54, 0}}};
    const auto without = fild::draw_birds_eye(town, {}, {}, 800);
    const auto with = fild::draw_birds_eye(town, {route}, {}, 800);
    ASSERT_EQ(with.size(), without.size());
    EXPECT_EQ(with.cols, 800);
    cv::Mat red;
    cv::inRange(with, cv::Scalar(40, 40, 230), cv::Scalar(40, 40, 230), red);
    EXPECT_GT(cv::countNonZero(red), 800);
    cv::inRange(without, cv::Scalar(40, 40, 230), cv::Scalar(40, 40, 230), red);
    EXPECT_LT(cv::countNonZero(red), 20);
}

TEST(BirdsEye, NamesThePartsOfARouteAndLeavesNoGaps)
{
    using fild::Stretch;
    const auto pose = [](double x, int lap, Stretch stretch) {
        return fild::RoutePose{x, lap, stretch, {x, 0, 0, 0, 0, 0}};
    };
    const auto lines = fild::route_lines({pose(0, 0, Stretch::lap),
                                          pose(1, 0, Stretch::lap),
                                          pose(2, 1, Stretch::lap),
                                          pose(3, 1, Stretch::link),
                                          pose(4, 1, Stretch::once),
                                          pose(5, 1, Stretch::opposite)});
    std::vector<std::string> names;
    names.reserve(lines.size());
    for (const auto& line : lines) names.push_back(line.name);
    EXPECT_THAT(names,
                ::testing::ElementsAre(
                    "lap 1", "lap 2", "connecting road", "driven once", "opposite direction"));
    for (std::size_t i = 1; i < lines.size(); ++i)
        EXPECT_EQ(lines[i].points.front(), lines[i - 1].points.back());
    EXPECT_TRUE(fild::route_lines({}).empty());
}

/** A route to the west is seen from the north: its heading is to the right, as on map_top.png. */
TEST(BirdsEye, HasTheHeadingAtTheStartToTheRight)
{
    fild::Town town(one_block());
    const auto mean_place = [&](const fild::RouteLine& route, const cv::Scalar& colour)
    {
        cv::Mat found;
        cv::inRange(fild::draw_birds_eye(town, {route}, {}, 800), colour, colour, found);
        const auto moments = cv::moments(found, true);
        EXPECT_GT(moments.m00, 20);
        return cv::Point2d(moments.m10 / moments.m00, moments.m01 / moments.m00);
    };
    const cv::Scalar start(178, 114, 0);
    const cv::Scalar end(0, 94, 213);
    for (const auto& far : {cv::Point3d(54, 0, 0), {0, 54, 0}})
        for (const bool is_back : {false, true})
        {
            fild::RouteLine route{"lap 1", {{0, 0, 0}, far / 2, far}};
            if (is_back) std::reverse(route.points.begin(), route.points.end());
            const auto way = mean_place(route, end) - mean_place(route, start);
            EXPECT_GT(way.x, 100) << far << is_back;
            EXPECT_LT(std::abs(way.y), 60) << far << is_back;
        }
}

/** To make it anew: synthetic-rawlog --birds-eye town.png --output town.rawlog, and
 *  convert -resize 1000x -quality 80 town.png tests/data/town.jpg (ImageMagick). */
TEST(BirdsEye, ThePictureInTheReadmeShowsTheTownAsItIs)
{
    const auto options = fild::options_of(fild::Preset::demo);
    fild::Town town(options.town);
    const auto route = fild::plan_route(options.route, town.grid(), 1);
    auto now = fild::draw_birds_eye(town, fild::route_lines(route), {});
    const auto in_readme = cv::imread(FILD_SOURCE_DIR "/tests/data/town.jpg");
    ASSERT_FALSE(in_readme.empty());
    cv::resize(now, now, in_readme.size(), 0, 0, cv::INTER_AREA);
    EXPECT_LT(difference(now, in_readme), 6);
}

}  // namespace
