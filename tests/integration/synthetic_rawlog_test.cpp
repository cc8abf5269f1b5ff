// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "fild/synthetic/synthetic_options.h"
#include "fild/synthetic/synthetic_recording.h"
#include "fild/synthetic/town.h"
#include "message_of.h"
#include "run_command.h"
#include "temporary_folder.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace
{
using fild::testing::Finished;
using fild::testing::read_text;
using fild::testing::run_command;
using fild::testing::TemporaryFolder;
using fild::testing::write_text;
using mrpt::poses::CPose3D;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

Finished run(const TemporaryFolder& folder, const std::string& arguments)
{
    return run_command("cd '" + folder.path() + "' && '" SYNTHETIC_RAWLOG "' " + arguments);
}

struct TruePose
{
    double timestamp = 0;
    CPose3D map_from_robot;
};

std::vector<TruePose> read_poses(const std::string& path)
{
    std::vector<TruePose> poses;
    std::istringstream file(read_text(path));
    double t = 0;
    mrpt::math::TPoint3D p;
    mrpt::math::CQuaternionDouble q;
    while (file >> t >> p.x >> p.y >> p.z >> q[1] >> q[2] >> q[3] >> q[0])
        poses.push_back({t, CPose3D(mrpt::poses::CPose3DQuat(p.x, p.y, p.z, q))});
    return poses;
}

/** The loops of a list, without its doubtful pairs. */
std::set<std::pair<std::size_t, std::size_t>> read_loops(const std::string& path)
{
    std::set<std::pair<std::size_t, std::size_t>> loops;
    std::istringstream file(read_text(path));
    for (std::string line; std::getline(file, line);)
    {
        std::size_t query = 0;
        std::size_t candidate = 0;
        std::string doubtful;
        std::istringstream words(line);
        if (line[0] != '#' && words >> query >> candidate && !(words >> doubtful))
            loops.emplace(query, candidate);
    }
    return loops;
}

template <class Observation>
std::vector<typename Observation::Ptr> read_all(const std::string& rawlog)
{
    std::vector<typename Observation::Ptr> all;
    fild::RawlogReader reader(rawlog);
    while (const auto observation = reader.next())
        if (auto wanted = std::dynamic_pointer_cast<Observation>(observation))
            all.push_back(wanted);
    return all;
}

double angle_between(const CPose3D& a, const CPose3D& b)
{
    return std::abs(std::remainder(a.yaw() - b.yaw(), 2 * M_PI)) * 180 / M_PI;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void expect_read_by_our_reader(const TemporaryFolder& folder)
{
    const auto path = folder.path("town.rawlog");
    const auto poses = read_poses(folder.path("town.gt.tum"));
    fild::RawlogReader reader(path);
    fild::FrameBuilder builder(fild::TInputOptions(), path);
    std::size_t frames = 0;
    while (const auto observation = reader.next())
    {
        if (!builder.accepts(*observation)) continue;
        const auto frame = builder.build(*observation);
        EXPECT_EQ(frame.defect, fild::Rejection::none);
        EXPECT_EQ(frame.image.size(), cv::Size(320, 240));
        ASSERT_LT(frames, poses.size());
        EXPECT_NEAR(frame.timestamp, poses[frames].timestamp, 2e-6);
        ++frames;
    }
    EXPECT_EQ(frames, poses.size());
}

/** \param images  that rawlog-edit must list. */
void expect_read_by_rawlog_edit(const TemporaryFolder& folder, std::size_t images)
{
    if (run_command("command -v rawlog-edit").exit_code != 0) return;  // Debian's mrpt-apps
    const auto in_folder = "cd '" + folder.path() + "' && rawlog-edit -i town.rawlog ";
    const auto info = run_command(in_folder + "--info");
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, AllOf(HasSubstr("CAMERA1"), HasSubstr("ODOMETRY")));
    const auto list =
        run_command(in_folder + "--list-images --text-file-output list.txt && cat list.txt");
    EXPECT_EQ(list.exit_code, 0) << list.err;
    std::size_t listed = 0;
    for (auto at = list.out.find(".jpg"); at != std::string::npos;
         at = list.out.find(".jpg", at + 1))
        ++listed;
    EXPECT_EQ(listed, images) << list.out;
}

void expect_loops_agree_with_the_poses(const TemporaryFolder& folder)
{
    const auto poses = read_poses(folder.path("town.gt.tum"));
    const auto loops = read_loops(folder.path("town.loops.txt"));
    EXPECT_GT(loops.size(), 20U);
    for (const auto& [query, candidate] : loops)
    {
        const auto& now = poses.at(query);
        const auto& then = poses.at(candidate);
        EXPECT_GE(now.timestamp - then.timestamp, 20);
        EXPECT_LE(now.map_from_robot.distanceTo(then.map_from_robot), 10.1);
        EXPECT_LE(angle_between(now.map_from_robot, then.map_from_robot), 46);
    }
}

void expect_each_return_to_a_pose_is_a_loop(const TemporaryFolder& folder)
{
    const auto poses = read_poses(folder.path("town.gt.tum"));
    const auto loops = read_loops(folder.path("town.loops.txt"));
    int returns = 0;
    for (std::size_t query = 0; query < poses.size(); ++query)
        for (std::size_t candidate = 0; candidate < query; ++candidate)
        {
            const auto& now = poses[query];
            const auto& then = poses[candidate];
            if (now.timestamp - then.timestamp < 20 ||
                now.map_from_robot.distanceTo(then.map_from_robot) > 1 ||
                angle_between(now.map_from_robot, then.map_from_robot) > 5)
                continue;
            EXPECT_EQ(loops.count({query, candidate}), 1U) << query << " " << candidate;
            ++returns;
        }
    EXPECT_GT(returns, 0);
}

/** The road in front of the robot lies at height 0, wherever the suspension leans the camera. */
void expect_the_road_at_the_robots_feet(const TemporaryFolder& folder)
{
    const auto poses = read_poses(folder.path("town.gt.tum"));
    const auto scans = read_all<mrpt::obs::CObservation3DRangeScan>(folder.path("town.rawlog"));
    ASSERT_EQ(scans.size(), poses.size());
    std::vector<double> heights;
    for (std::size_t frame = 0; frame < scans.size(); ++frame)
    {
        const auto& scan = *scans[frame];
        const auto& camera = scan.cameraParams;
        const auto map_from_camera =
            poses[frame].map_from_robot + scan.sensorPose + scan.relativePoseIntensityWRTDepth;
        for (unsigned u = 40; u < 280; u += 20)
        {
            const unsigned v = 230;
            const double z = 0.001 * scan.rangeImage(v, u);
            const auto point = map_from_camera.composePoint(
                {z * (u - camera.cx()) / camera.fx(), z * (v - camera.cy()) / camera.fy(), z});
            heights.push_back(std::abs(point.z));
        }
    }
    EXPECT_LT(median(heights), 0.01);
}

// One test a sensor, since ctest makes a process, and so a recording, for each.
class TinyTown : public ::testing::TestWithParam<std::string>
{
};

TEST_P(TinyTown, IsReadBackAndAgreesWithItsTruth)
{
    const TemporaryFolder folder;
    const auto finished =
        run(folder, "--preset tiny --sensor " + GetParam() + " --output town.rawlog");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, StartsWith("town.rawlog: 60 frames, "));
    EXPECT_THAT(finished.err, HasSubstr("100 %"));
    expect_read_by_our_reader(folder);
    expect_read_by_rawlog_edit(folder, GetParam() == "stereo" ? 120 : 60);
    expect_loops_agree_with_the_poses(folder);
    expect_each_return_to_a_pose_is_a_loop(folder);
    if (GetParam() == "rgbd") expect_the_road_at_the_robots_feet(folder);
}

INSTANTIATE_TEST_SUITE_P(Sensors, TinyTown, ::testing::Values("mono", "stereo", "rgbd"));

/** Of a disparity that is right to about a pixel, one right to a small part of it: least squares
 *  over a window, by Gauss and Newton. Nothing where there is too little texture for it. */
std::optional<double> refined_disparity(const cv::Mat_<float>& left,
                                        const cv::Mat_<float>& right,
                                        cv::Point at,
                                        double disparity)
{
    constexpr int kReach = 4;
    for (int iteration = 0; iteration < 6; ++iteration)
    {
        double squares = 0;
        double products = 0;
        for (int dy = -kReach; dy <= kReach; ++dy)
            for (int dx = -kReach; dx <= kReach; ++dx)
            {
                const double x = at.x + dx - disparity;
                const int whole = static_cast<int>(std::floor(x));
                if (whole < 1 || whole + 2 >= right.cols) return std::nullopt;
                const float* const row = right[at.y + dy] + whole;
                const auto share = static_cast<float>(x - whole);
                const float value = (1 - share) * row[0] + share * row[1];
                const float slope =
                    ((1 - share) * (row[1] - row[-1]) + share * (row[2] - row[0])) / 2;
                squares += static_cast<double>(slope * slope);
                products += static_cast<double>(slope * (left(at.y + dy, at.x + dx) - value));
            }
        if (squares < 3000) return std::nullopt;
        disparity -= products / squares;
    }
    return disparity;
}

/** What a matched pair says against what was drawn. */
struct DepthCheck
{
    double median_error = 0;  ///< share of the depth
    std::size_t matched = 0;
};

cv::Mat_<float> smoothed(const cv::Mat& image)
{
    cv::Mat result;
    image.convertTo(result, CV_32F);
    cv::GaussianBlur(result, result, {}, 1);
    return result;
}

DepthCheck check_depth(const mrpt::obs::CObservationStereoImages& pair,
                       const std::string& images_dir,
                       const cv::Mat_<float>& depth)
{
    const auto load = [&](const mrpt::img::CImage& image)
    { return cv::imread(images_dir + "/" + image.getExternalStorageFile(), cv::IMREAD_GRAYSCALE); };
    const auto left = load(pair.imageLeft);
    const auto right = load(pair.imageRight);
    cv::Mat matched;
    cv::StereoSGBM::create(0, 96, 7, 8 * 49, 32 * 49, 1, 31, 10, 50, 2)
        ->compute(left, right, matched);
    const cv::Mat_<float> smooth_left = smoothed(left);
    const cv::Mat_<float> smooth_right = smoothed(right);
    const double focal_baseline = pair.leftCamera.fx() * pair.rightCameraPose.x();
    std::vector<double> errors;
    for (int v = 8; v < depth.rows - 8; v += 4)
        for (int u = 8; u < depth.cols - 8; u += 4)
        {
            const double coarse = matched.at<short>(v, u) / 16.0;
            if (coarse <= 0 || depth(v, u) == 0) continue;
            const auto fine = refined_disparity(smooth_left, smooth_right, {u, v}, coarse);
            if (!fine || std::abs(*fine - coarse) > 1 || *fine < 1) continue;
            const auto drawn = static_cast<double>(depth(v, u));
            errors.push_back(std::abs(focal_baseline / *fine / drawn - 1));
        }
    return {median(errors), errors.size()};
}

// Recorded images, matched along their rows, against the depth that the town has there.
TEST(StereoTown, DepthFromTheImagesIsTheDepthDrawn)
{
    const TemporaryFolder folder;
    const auto finished = run(folder,
                              "--preset tiny --set sensors.width=640 --set sensors.height=480 "
                              "--frames 8 --output town.rawlog --quiet");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto poses = read_poses(folder.path("town.gt.tum"));
    const auto pairs = read_all<mrpt::obs::CObservationStereoImages>(folder.path("town.rawlog"));
    ASSERT_EQ(pairs.size(), 8U);
    const auto options = options_of(fild::Preset::tiny);
    fild::Town town(options.town);
    fild::TSensorOptions sensors;
    for (std::size_t frame = 0; frame < pairs.size(); ++frame)
    {
        const auto map_from_left = poses[frame].map_from_robot + CPose3D(pairs[frame]->cameraPose);
        const auto view = town.draw(
            camera_of(sensors), map_from_left, conditions_of_lap(options.conditions, 0, 1));
        const auto check = check_depth(*pairs[frame], folder.path("town_Images"), view.depth);
        EXPECT_LT(check.median_error, 0.02) << "frame " << frame;
        EXPECT_GT(check.matched, 2000U) << "frame " << frame;
        RecordProperty("median_error_" + std::to_string(frame), std::to_string(check.median_error));
    }
}

TEST(SyntheticRawlog, OdometryDriftsAsAsked)
{
    const TemporaryFolder folder;
    // The drawing is not looked at: as small as can be.
    const auto finished = run(folder,
                              "--preset tiny --sensor mono --set sensors.width=16 "
                              "--set sensors.height=16 --output town.rawlog --quiet");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const auto poses = read_poses(folder.path("town.gt.tum"));
    const auto odometry = read_all<mrpt::obs::CObservationOdometry>(folder.path("town.rawlog"));
    ASSERT_EQ(odometry.size(), poses.size());
    std::vector<double> errors;
    for (std::size_t begin = 0; begin < poses.size(); ++begin)
    {
        double way = 0;
        std::size_t end = begin;
        while (way < 100 && ++end < poses.size())
            way += poses[end].map_from_robot.distanceTo(poses[end - 1].map_from_robot);
        if (end >= poses.size()) break;
        const auto moved = CPose3D(mrpt::poses::CPose2D(poses[end].map_from_robot)) -
                           CPose3D(mrpt::poses::CPose2D(poses[begin].map_from_robot));
        const CPose3D measured(odometry[end]->odometry - odometry[begin]->odometry);
        errors.push_back(100 * measured.distanceTo(moved) / way);
    }
    double sum = 0;
    for (const double error : errors) sum += error;
    EXPECT_GT(sum / static_cast<double>(errors.size()), 0.8);
    EXPECT_LT(sum / static_cast<double>(errors.size()), 2.2);
}

TEST(SyntheticRawlog, MakesTheSameBytesAgainAndWithTwoThreads)
{
    const TemporaryFolder one;
    const TemporaryFolder two;
    const std::string arguments = "--preset tiny --frames 3 --seed 5 --output a.rawlog ";
    ASSERT_EQ(run(one, arguments + "--threads 1").exit_code, 0);
    ASSERT_EQ(run(two, arguments + "--threads 2").exit_code, 0);
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(one.path()))
    {
        if (!entry.is_regular_file()) continue;
        const auto name = fs::relative(entry.path(), one.path()).string();
        EXPECT_EQ(read_text(one.path(name)), read_text(two.path(name))) << name;
        ++files;
    }
    EXPECT_EQ(files, 9U);
}

TEST(SyntheticRawlog, TakesAConfigurationAndFlagsOverIt)
{
    const TemporaryFolder folder;
    write_text(folder.path("my.ini"),
               "[sensors]\nsensor = mono\nwidth = 64\nheight = 48\nodometry = action\n"
               "[route]\nmax_frames = 9\n");
    const auto finished = run(folder,
                              "--preset tiny --config my.ini --set sensors.width=80 "
                              "--sensor stereo --frames 2 --embed --output a.rawlog");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("2 frames"));
    EXPECT_FALSE(fs::exists(folder.path("a_Images")));
    const auto pairs = read_all<mrpt::obs::CObservationStereoImages>(folder.path("a.rawlog"));
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0]->imageLeft.getWidth(), 80U);
    EXPECT_EQ(pairs[0]->imageLeft.getHeight(), 48U);
    EXPECT_TRUE(read_all<mrpt::obs::CObservationOdometry>(folder.path("a.rawlog")).empty());
}

TEST(SyntheticRawlog, ShowsHelpAndVersion)
{
    const TemporaryFolder folder;
    const auto help = run(folder, "--help");
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* flag : {"--output",
                             "--preset",
                             "--sensor",
                             "--frames",
                             "--seed",
                             "--config",
                             "--set",
                             "--embed",
                             "--quiet"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    EXPECT_THAT(run(folder, "--version").out, HasSubstr("0.1"));
}

/** Expects one line on stderr, and no file; returns the line. */
std::string error_of(const std::string& arguments, int exit_code)
{
    const TemporaryFolder folder;
    const auto finished = run(folder, arguments);
    EXPECT_EQ(finished.exit_code, exit_code) << arguments;
    EXPECT_THAT(finished.err, AllOf(StartsWith("synthetic-rawlog: "), EndsWith("\n")));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_TRUE(fs::is_empty(folder.path())) << arguments;
    return finished.err;
}

TEST(SyntheticRawlog, DrawsTheHardTown)
{
    const TemporaryFolder folder;
    const auto finished =
        run(folder,
            "--preset hard --sensor mono --set sensors.width=160 --set sensors.height=120 "
            "--frames 3 --output hard.rawlog --quiet");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("3 frames"));
    EXPECT_THAT(error_of("--preset tiny --set route.lap_offset_m=9 --output a.rawlog", 1),
                HasSubstr("lap_offset_m"));
}

TEST(SyntheticRawlog, TellsWhatIsWrong)
{
    EXPECT_THAT(error_of("", 2), HasSubstr("--output"));
    EXPECT_THAT(error_of("--output a.bag", 2), HasSubstr("NAME.rawlog"));
    EXPECT_THAT(error_of("--output a.rawlog --preset huge", 2), HasSubstr("huge"));
    EXPECT_THAT(error_of("--output a.rawlog --sensor sonar", 2), HasSubstr("sonar"));
    EXPECT_THAT(error_of("--output a.rawlog --frames 0", 2), HasSubstr("--frames"));
    EXPECT_THAT(error_of("--output a.rawlog --set route.lap=3", 1),
                HasSubstr("[route] unknown key 'lap'"));
    EXPECT_THAT(error_of("--output a.rawlog --set route.laps=1", 1), HasSubstr("laps=1"));
    EXPECT_THAT(error_of("--output a.rawlog --set route.circuit_columns=4", 2),
                HasSubstr("circuit_columns=4 is more than the town has room for"));
    EXPECT_THAT(error_of("--output a.rawlog --config none.ini", 1), HasSubstr("none.ini"));
    EXPECT_THAT(error_of("--output none/a.rawlog", 1), HasSubstr("none/a.rawlog"));
}

TEST(SyntheticRawlog, ReplacesNothing)
{
    const TemporaryFolder folder;
    write_text(folder.path("a.gt.tum"), "mine");
    const auto finished = run(folder, "--preset tiny --output a.rawlog");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("a.gt.tum exists already; remove it"));
    EXPECT_EQ(read_text(folder.path("a.gt.tum")), "mine");
}

TEST(SyntheticRawlog, LeavesNothingWhenItIsInterrupted)
{
    const TemporaryFolder folder;
    const auto finished = run_command("cd '" + folder.path() +
                                      "' && timeout --preserve-status --signal=INT 5 "
                                      "'" SYNTHETIC_RAWLOG "' --output a.rawlog --quiet");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("interrupted"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
