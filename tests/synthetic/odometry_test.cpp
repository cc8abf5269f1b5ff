// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/odometry.h"

#include "fild/synthetic/route.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <limits>

namespace
{
using fild::drifting_odometry;
using fild::OdometryDimensions;
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;
using Poses = std::vector<TPose3D>;

Poses straight_road(int poses)
{
    Poses road;
    for (int i = 0; i < poses; ++i) road.emplace_back(2.5 * i, 0, 0, 0, 0, 0);
    return road;
}

Poses town_drive(std::uint64_t seed)
{
    Poses drive;
    for (const auto& pose : fild::plan_route(fild::TRouteOptions(), {}, seed))
        drive.push_back(pose.map_from_robot);
    return drive;
}

/** Without what a planar odometry cannot see. */
Poses flat(Poses poses)
{
    for (auto& pose : poses) pose = TPose3D(pose.x, pose.y, 0, pose.yaw, 0, 0);
    return poses;
}

/** Mean error of the relative position after 100 m, in percent, over all stretches of 100 m. */
double drift_percent(const Poses& truth, const Poses& odometry)
{
    std::vector<double> way{0};
    for (std::size_t i = 1; i < truth.size(); ++i)
        way.push_back(way.back() + (truth[i] - truth[i - 1]).norm());
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0, j = 0; i < truth.size(); ++i)
    {
        while (j < truth.size() && way[j] - way[i] < 100) ++j;
        if (j == truth.size()) break;
        const auto moved = CPose3D(truth[j]) - CPose3D(truth[i]);
        const auto measured = CPose3D(odometry[j]) - CPose3D(odometry[i]);
        sum += (measured - moved).norm() / (way[j] - way[i]);
        ++count;
    }
    return 100 * sum / count;
}

/** Mean over many seeds of what a drive's odometry drifts by. */
template <class Drive>
double mean_drift(Drive&& drive, OdometryDimensions dimensions, double percent)
{
    constexpr std::uint64_t kSeeds = 40;
    double sum = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    {
        const Poses truth = drive(seed);
        const auto odometry = drifting_odometry(truth, dimensions, percent, seed);
        sum +=
            drift_percent(dimensions == OdometryDimensions::planar ? flat(truth) : truth, odometry);
    }
    return sum / kSeeds;
}

TEST(Odometry, DriftsAsAskedOnAStraightRoad)
{
    const auto road = [](std::uint64_t) { return straight_road(400); };
    EXPECT_NEAR(mean_drift(road, OdometryDimensions::planar, 1.5), 1.5, 0.15);
    EXPECT_NEAR(mean_drift(road, OdometryDimensions::spatial, 1.5), 1.5, 0.15);
    EXPECT_NEAR(mean_drift(road, OdometryDimensions::planar, 0.5), 0.5, 0.05);
}

TEST(Odometry, DriftsAsAskedInTheTown)
{
    const auto drive = town_drive;
    EXPECT_NEAR(mean_drift(drive, OdometryDimensions::planar, 1.5), 1.5, 0.2);
    EXPECT_NEAR(mean_drift(drive, OdometryDimensions::spatial, 1.5), 1.5, 0.2);
}

TEST(Odometry, DriftsBetweenOneAndTwoPercentOnMostSingleDrives)
{
    int inside = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        const auto truth = flat(town_drive(seed));
        const double drift =
            drift_percent(truth, drifting_odometry(truth, OdometryDimensions::planar, 1.5, seed));
        EXPECT_GT(drift, 0.5) << seed;
        EXPECT_LT(drift, 2.5) << seed;
        if (drift > 1 && drift < 2) ++inside;
    }
    EXPECT_GT(inside, 32);
}

TEST(Odometry, WithoutDriftIsTheTruthFromTheStart)
{
    const auto truth = town_drive(3);
    const auto spatial = drifting_odometry(truth, OdometryDimensions::spatial, 0, 1);
    const auto planar = drifting_odometry(truth, OdometryDimensions::planar, 0, 1);
    ASSERT_EQ(spatial.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
        const auto moved = CPose3D(truth[i]) - CPose3D(truth[0]);
        EXPECT_LT(CPose3D(spatial[i]).distanceTo(moved), 1e-6);
        const auto flat_truth = flat({truth[0], truth[i]});
        const auto moved_flat = CPose3D(flat_truth[1]) - CPose3D(flat_truth[0]);
        EXPECT_LT(CPose3D(planar[i]).distanceTo(moved_flat), 1e-6);
        EXPECT_NEAR(std::remainder(planar[i].yaw - moved_flat.yaw(), 2 * M_PI), 0, 1e-9);
    }
}

TEST(Odometry, StartsAtTheIdentityAndStaysPlanar)
{
    const auto odometry = drifting_odometry(town_drive(1), OdometryDimensions::planar, 1.5, 1);
    EXPECT_EQ(odometry.front(), TPose3D());
    for (const auto& pose : odometry)
    {
        EXPECT_EQ(pose.z, 0);
        EXPECT_EQ(pose.pitch, 0);
        EXPECT_EQ(pose.roll, 0);
    }
}

TEST(Odometry, ErrsInSpaceMostInPositionAndHeading)
{
    const auto truth = town_drive(1);
    const auto odometry = drifting_odometry(truth, OdometryDimensions::spatial, 1.5, 1);
    double highest = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
        highest = std::max(highest, std::abs(odometry[i].z));
        EXPECT_NEAR(odometry[i].pitch, truth[i].pitch, 0.03);
        EXPECT_NEAR(odometry[i].roll, truth[i].roll, 0.03);
    }
    EXPECT_GT(highest, 0.1);
    EXPECT_LT(highest, 20);
}

TEST(Odometry, DependsOnTheSeedAlone)
{
    const auto road = straight_road(50);
    const auto measured = [&](std::uint64_t seed)
    { return drifting_odometry(road, OdometryDimensions::planar, 1.5, seed).back(); };
    EXPECT_EQ(measured(1), measured(1));
    EXPECT_NE(measured(1), measured(2));
}

TEST(Odometry, TakesNoneOneAndStandingPoses)
{
    EXPECT_TRUE(drifting_odometry({}, OdometryDimensions::planar, 1.5, 1).empty());
    EXPECT_EQ(drifting_odometry({TPose3D(1, 2, 0, 1, 0, 0)}, OdometryDimensions::spatial, 1.5, 1),
              Poses(1));
    const Poses standing(5, TPose3D(1, 2, 0, 1, 0, 0));
    for (const auto& pose : drifting_odometry(standing, OdometryDimensions::spatial, 1.5, 1))
        EXPECT_LT(CPose3D(pose).norm(), 1e-9);
}

TEST(Odometry, RefusesANegativeDrift)
{
    EXPECT_THROW(drifting_odometry({}, OdometryDimensions::planar, -1, 1), std::invalid_argument);
    EXPECT_THROW(drifting_odometry(
                     {}, OdometryDimensions::planar, std::numeric_limits<double>::quiet_NaN(), 1),
                 std::invalid_argument);
}

}  // namespace
