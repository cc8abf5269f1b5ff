// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/synthetic_recording.h"

#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/paired_rawlog.h"
#include "flat_scene.h"
#include "message_of.h"
#include "temporary_folder.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <sstream>

namespace
{
using fild::OdometryKind;
using fild::SensorKind;
using fild::StreetGrid;
using fild::SyntheticRequest;
using fild::SyntheticSummary;
using fild::testing::draw_panels;
using fild::testing::message_of;
using fild::testing::Panel;
using fild::testing::read_text;
using fild::testing::TemporaryFolder;
using fild::testing::write_text;
using mrpt::poses::CPose3D;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/** One block, one row behind it. */
StreetGrid small_town()
{
    StreetGrid grid;
    grid.columns = 1;
    grid.block_length = grid.block_width = 40;
    return grid;
}

/** The road, and a wall on each side of the town. */
std::vector<Panel> scene()
{
    return {{{0, 0, 0}, {300, 0, 0}, {0, 300, 0}},
            {{90, 50, 10}, {0, 90, 0}, {0, 0, 10}},
            {{-30, 50, 10}, {0, 90, 0}, {0, 0, 10}},
            {{30, 140, 10}, {90, 0, 0}, {0, 0, 10}},
            {{30, -30, 10}, {90, 0, 0}, {0, 0, 10}}};
}

fild::RenderedView draw(const fild::CameraModel& camera,
                        const CPose3D& map_from_camera,
                        const fild::LapConditions& conditions)
{
    auto view = draw_panels(scene(), camera, map_from_camera);
    view.image *= 0.8 * conditions.exposure;
    return view;
}

/** Two laps with a frame each 12 m or so, 64x48 pixels. */
SyntheticRequest small_request(const TemporaryFolder& folder, SensorKind sensor)
{
    SyntheticRequest request;
    request.rawlog_path = folder.path("run.rawlog");
    auto& options = request.options;
    options.route.circuit_columns = 1;
    options.route.speed_m_per_s = 6;
    options.route.frames_per_second = 0.5;
    options.sensors.sensor = sensor;
    options.sensors.width = 64;
    options.sensors.height = 48;
    return request;
}

SyntheticSummary record(const SyntheticRequest& request)
{
    return write_synthetic_recording(request, small_town(), draw, nullptr);
}

std::vector<mrpt::obs::CObservation::Ptr> read_all(const std::string& rawlog)
{
    std::vector<mrpt::obs::CObservation::Ptr> all;
    fild::RawlogReader reader(rawlog);
    while (auto observation = reader.next()) all.push_back(observation);
    return all;
}

std::size_t count_labels(const std::string& rawlog, const std::string& label)
{
    const auto all = read_all(rawlog);
    return static_cast<std::size_t>(std::count_if(all.begin(),
                                                  all.end(),
                                                  [&](const auto& observation)
                                                  { return observation->sensorLabel == label; }));
}

std::vector<fild::Frame> read_frames(const std::string& rawlog)
{
    fild::PairedRawlog reader(rawlog, {});
    fild::FrameBuilder builder(fild::TInputOptions(), rawlog);
    std::vector<fild::Frame> frames;
    while (const auto observation = reader.next())
        if (builder.accepts(*observation)) frames.push_back(builder.build(*observation));
    return frames;
}

/** Path in the folder -> bytes, of every file. */
std::map<std::string, std::string> contents(const TemporaryFolder& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file())
            files[fs::relative(entry.path(), folder.path()).string()] =
                read_text(entry.path().string());
    return files;
}

class EachSensor : public ::testing::TestWithParam<SensorKind>
{
};

TEST_P(EachSensor, IsReadBackByOurReader)
{
    const TemporaryFolder folder;
    const auto request = small_request(folder, GetParam());
    const auto summary = record(request);
    const auto frames = read_frames(request.rawlog_path);
    ASSERT_EQ(frames.size(), summary.frames);
    EXPECT_GT(frames.size(), 30U);
    const auto camera = camera_of(request.options.sensors);
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        EXPECT_EQ(frames[i].defect, fild::Rejection::none);
        EXPECT_EQ(frames[i].image.size(), cv::Size(64, 48));
        EXPECT_EQ(frames[i].image.channels(), 3);
        EXPECT_DOUBLE_EQ(frames[i].timestamp, fild::kRecordingStart + 2 * static_cast<double>(i));
        ASSERT_TRUE(frames[i].camera);
        EXPECT_EQ(frames[i].camera->fx, camera.fx);
        EXPECT_EQ(frames[i].camera->cx, camera.cx);
    }
}

TEST_P(EachSensor, EmbedsThePixels)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, GetParam());
    request.embed = true;
    request.options.route.max_frames = 3;
    EXPECT_THAT(
        record(request).paths,
        ElementsAre(
            folder.path("run.rawlog"), folder.path("run.gt.tum"), folder.path("run.loops.txt")));
    EXPECT_FALSE(fs::exists(folder.path("run_Images")));
    const auto frames = read_frames(request.rawlog_path);
    ASSERT_EQ(frames.size(), 3U);
    for (const auto& frame : frames) EXPECT_EQ(frame.image.size(), cv::Size(64, 48));
}

TEST_P(EachSensor, HasTheSameBytesForTheSameSeed)
{
    const TemporaryFolder one;
    const TemporaryFolder two;
    for (const auto* folder : {&one, &two})
    {
        auto request = small_request(*folder, GetParam());
        request.options.sensors.gps = true;
        request.options.sensors.odometry = OdometryKind::robot_pose;
        record(request);
    }
    EXPECT_EQ(contents(one), contents(two));
    const TemporaryFolder three;
    auto request = small_request(three, GetParam());
    request.options.town.seed = 2;
    record(request);
    const auto first = contents(one);
    const auto other = contents(three);
    for (const auto& [name, bytes] : other)
    {
        const auto same_name = first.find(name);
        EXPECT_TRUE(name == "run.loops.txt" || same_name == first.end() ||
                    same_name->second != bytes)
            << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Sensors,
    EachSensor,
    ::testing::Values(SensorKind::mono, SensorKind::stereo, SensorKind::pair, SensorKind::rgbd));

/** A pair whose right image shows what is to be seen a tenth of a second later, from further on. */
TEST(SyntheticRecording, TakesTheRightImageOfAPairLater)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::pair);
    request.options.route.max_frames = 3;
    request.options.sensors.right_delay_seconds = 0.1;
    std::vector<CPose3D> poses;
    const auto remember = [&](const auto& camera, const auto& pose, const auto& conditions)
    {
        poses.push_back(pose);
        return draw(camera, pose, conditions);
    };
    write_synthetic_recording(request, small_town(), remember, nullptr);
    ASSERT_EQ(poses.size(), 6U);
    for (std::size_t i = 0; i < poses.size(); i += 2)
    {
        const auto moved = poses[i + 1] - poses[i];
        EXPECT_NEAR(moved.x(), request.options.sensors.baseline_m, 0.1);
        EXPECT_NEAR(moved.z(), 0.6, 0.15) << "6 m/s";
    }
    EXPECT_EQ(count_labels(request.rawlog_path, "CAMERA_LEFT"), 3U);
    EXPECT_EQ(count_labels(request.rawlog_path, "CAMERA_RIGHT"), 3U);
}

/** Through the lens, and straightened by our reader, a view is what it is without the lens. */
TEST(SyntheticRecording, BendsTheImagesByTheLens)
{
    std::vector<fild::Frame> frames;
    for (const bool is_bent : {false, true})
    {
        const TemporaryFolder folder;
        auto request = small_request(folder, SensorKind::mono);
        request.embed = true;
        request.options.route.max_frames = 1;
        request.options.conditions.image_noise = 0;
        request.options.sensors.width = 320;
        request.options.sensors.height = 240;
        if (is_bent)
        {
            request.options.sensors.lens_k1 = -0.28;
            request.options.sensors.lens_k2 = 0.07;
        }
        record(request);
        frames.push_back(read_frames(request.rawlog_path).at(0));
    }
    cv::Mat difference;
    cv::absdiff(frames[0].image, frames[1].image, difference);
    const auto mean = cv::mean(difference);
    EXPECT_LT(mean[0] + mean[1] + mean[2], 9) << "in three colours";
    EXPECT_EQ(frames[1].camera->fx, frames[0].camera->fx);
}

TEST(SyntheticRecording, KeepsTheImagesBesideTheRawlog)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::stereo);
    request.options.route.max_frames = 2;
    const auto summary = record(request);
    EXPECT_THAT(summary.paths,
                ElementsAre(folder.path("run.rawlog"),
                            folder.path("run.gt.tum"),
                            folder.path("run.loops.txt"),
                            folder.path("run_Images")));
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents(folder)) names.push_back(name);
    EXPECT_THAT(names,
                ElementsAre("run.gt.tum",
                            "run.loops.txt",
                            "run.rawlog",
                            "run_Images/frame_000000_left.jpg",
                            "run_Images/frame_000000_right.jpg",
                            "run_Images/frame_000001_left.jpg",
                            "run_Images/frame_000001_right.jpg"));
}

TEST(SyntheticRecording, AShorterOneIsTheBeginningOfTheWhole)
{
    const TemporaryFolder whole;
    const TemporaryFolder begin;
    record(small_request(whole, SensorKind::mono));
    auto request = small_request(begin, SensorKind::mono);
    request.options.route.max_frames = 5;
    EXPECT_EQ(record(request).frames, 5U);
    const auto of_whole = contents(whole);
    for (const auto& [name, bytes] : contents(begin))
        EXPECT_TRUE(name.find(".jpg") == std::string::npos || bytes == of_whole.at(name)) << name;
    const auto poses = read_text(begin.path("run.gt.tum"));
    EXPECT_EQ(poses, of_whole.at("run.gt.tum").substr(0, poses.size()));
    const auto few = read_all(begin.path("run.rawlog"));
    const auto many = read_all(whole.path("run.rawlog"));
    for (std::size_t i = 0; i < few.size(); ++i)
    {
        const auto a = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(few[i]);
        const auto b = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(many[i]);
        ASSERT_EQ(!a, !b);
        EXPECT_TRUE(!a || a->odometry == b->odometry);
    }
}

TEST(SyntheticRecording, WritesTheTruePoseOfEachFrame)
{
    const TemporaryFolder folder;
    const auto request = small_request(folder, SensorKind::mono);
    const auto summary = record(request);
    const auto route = plan_route(request.options.route, small_town(), 1);
    std::ifstream file(folder.path("run.gt.tum"));
    std::size_t frame = 0;
    double t = 0;
    double x = 0;
    double y = 0;
    double z = 0;
    double qx = 0;
    double qy = 0;
    double qz = 0;
    double qw = 0;
    for (; file >> t >> x >> y >> z >> qx >> qy >> qz >> qw; ++frame)
    {
        ASSERT_LT(frame, route.size());
        EXPECT_DOUBLE_EQ(t, fild::kRecordingStart + route[frame].seconds);
        const CPose3D read(
            mrpt::poses::CPose3DQuat(x, y, z, mrpt::math::CQuaternionDouble(qw, qx, qy, qz)));
        const auto error = read - CPose3D(route[frame].map_from_robot);
        EXPECT_LT(error.norm(), 2e-6);
        EXPECT_NEAR(error.yaw(), 0, 1e-7);
        EXPECT_NEAR(error.roll(), 0, 1e-7);
    }
    EXPECT_EQ(frame, summary.frames);
}

TEST(SyntheticRecording, FindsTheLoopsOfTheSecondLap)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::mono);
    request.options.route.frames_per_second = 1;
    const auto summary = record(request);
    const auto route = plan_route(request.options.route, small_town(), 1);
    EXPECT_GT(summary.queries_with_loop, 30U);
    EXPECT_GE(summary.loops, summary.queries_with_loop);
    std::istringstream lines(read_text(folder.path("run.loops.txt")));
    std::string line;
    std::size_t pairs = 0;
    std::size_t doubtful_pairs = 0;
    while (std::getline(lines, line))
    {
        if (line[0] == '#') continue;
        std::size_t query = 0;
        std::size_t candidate = 0;
        std::istringstream words(line);
        words >> query >> candidate;
        std::string doubtful;
        const bool is_loop = !(words >> doubtful);
        const auto& then = route.at(candidate);
        const auto& now = route.at(query);
        const double metres = CPose3D(now.map_from_robot).distanceTo(CPose3D(then.map_from_robot));
        EXPECT_GE(now.seconds - then.seconds, request.options.truth.min_age_seconds) << line;
        EXPECT_LT(metres, is_loop ? 10 : 100) << line;
        EXPECT_FALSE(is_loop && now.stretch == fild::Stretch::opposite) << line;
        EXPECT_FALSE(is_loop && now.stretch == fild::Stretch::once) << line;
        pairs += is_loop ? 1U : 0U;
        doubtful_pairs += is_loop ? 0U : 1U;
    }
    EXPECT_EQ(pairs, summary.loops);
    EXPECT_GT(doubtful_pairs, pairs);
}

TEST(SyntheticRecording, WritesTheAskedOdometryAndGps)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::mono);
    request.options.route.max_frames = 4;
    const auto labels = [&](OdometryKind odometry, bool gps)
    {
        request.rawlog_path =
            folder.path(std::to_string(static_cast<int>(odometry)) + (gps ? "g" : "n") + ".rawlog");
        request.options.sensors.odometry = odometry;
        request.options.sensors.gps = gps;
        record(request);
        return std::vector<std::size_t>{count_labels(request.rawlog_path, "CAMERA1"),
                                        count_labels(request.rawlog_path, "ODOMETRY"),
                                        count_labels(request.rawlog_path, "GPS")};
    };
    EXPECT_THAT(labels(OdometryKind::planar, false), ElementsAre(4, 4, 0));
    EXPECT_THAT(labels(OdometryKind::robot_pose, true), ElementsAre(4, 4, 4));
    EXPECT_THAT(labels(OdometryKind::none, false), ElementsAre(4, 0, 0));
    EXPECT_THAT(labels(OdometryKind::action, true), ElementsAre(4, 0, 4));
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(request.rawlog_path));
    ASSERT_EQ(rawlog.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(rawlog.getType(i),
                  i % 2 == 0 ? mrpt::obs::CRawlog::etActionCollection
                             : mrpt::obs::CRawlog::etSensoryFrame);
}

TEST(SyntheticRecording, ReportsEachFrame)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::mono);
    request.options.route.max_frames = 3;
    std::vector<std::size_t> done;
    write_synthetic_recording(request,
                              small_town(),
                              draw,
                              [&](std::size_t frame, std::size_t frames, std::size_t)
                              {
                                  done.push_back(frame);
                                  EXPECT_EQ(frames, 3U);
                              });
    EXPECT_THAT(done, ElementsAre(1, 2, 3));
}

TEST(SyntheticRecording, LeavesNothingWhenItIsInterrupted)
{
    const TemporaryFolder folder;
    const auto stop = [](std::size_t frame, std::size_t, std::size_t)
    {
        if (frame == 3) throw std::runtime_error("interrupted");
    };
    EXPECT_EQ(message_of<std::runtime_error>(
                  [&]
                  {
                      write_synthetic_recording(
                          small_request(folder, SensorKind::stereo), small_town(), draw, stop);
                  }),
              "interrupted");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SyntheticRecording, RefusesToReplaceAnything)
{
    for (const auto* name : {"run.rawlog", "run.gt.tum", "run.loops.txt", "run_Images"})
    {
        const TemporaryFolder folder;
        write_text(folder.path(name), "mine");
        EXPECT_THAT(message_of<std::runtime_error>(
                        [&] { record(small_request(folder, SensorKind::mono)); }),
                    HasSubstr(std::string(name) + " exists already"));
        EXPECT_EQ(read_text(folder.path(name)), "mine");
        EXPECT_EQ(contents(folder).size(), 1U);
    }
}

TEST(SyntheticRecording, RefusesBadRequests)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::mono);
    request.rawlog_path = folder.path("run.txt");
    EXPECT_THAT(message_of<std::invalid_argument>([&] { record(request); }),
                HasSubstr("NAME.rawlog"));
    request = small_request(folder, SensorKind::mono);
    request.options.sensors.width = 1;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { record(request); }),
                HasSubstr("[sensors] width=1"));
    request = small_request(folder, SensorKind::mono);
    request.rawlog_path = folder.path("none/run.rawlog");
    EXPECT_THAT(message_of<std::runtime_error>([&] { record(request); }),
                HasSubstr("none/run.rawlog"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SyntheticRecording, ShowsTheRoadUsersOfEachFrame)
{
    const TemporaryFolder folder;
    auto request = small_request(folder, SensorKind::stereo);
    request.options.route.max_frames = 6;
    std::vector<std::size_t> shown;
    const auto count_users = [&](const fild::CameraModel& camera,
                                 const CPose3D& map_from_camera,
                                 const fild::LapConditions& conditions)
    {
        shown.push_back(conditions.road_users.size());
        return draw(camera, map_from_camera, conditions);
    };
    write_synthetic_recording(request, small_town(), count_users, nullptr);
    EXPECT_THAT(shown, ::testing::Each(0U));
    shown.clear();
    request.rawlog_path = folder.path("busy.rawlog");
    request.options.conditions.occluders = 1;
    write_synthetic_recording(request, small_town(), count_users, nullptr);
    ASSERT_EQ(shown.size(), 12U);
    for (std::size_t i = 0; i < shown.size(); i += 2)
    {
        EXPECT_GT(shown[i], 10U);
        EXPECT_EQ(shown[i], shown[i + 1]) << "both cameras see the same moment";
    }
}

TEST(SyntheticRecording, RoadUsersOfAShorterOneAreThoseOfTheWhole)
{
    const auto places = [](int max_frames)
    {
        const TemporaryFolder folder;
        auto request = small_request(folder, SensorKind::mono);
        request.options.route.max_frames = max_frames;
        request.options.conditions.occluders = 1;
        std::vector<double> seen;
        const auto note_users = [&](const fild::CameraModel& camera,
                                    const CPose3D& map_from_camera,
                                    const fild::LapConditions& conditions)
        {
            for (const auto& user : conditions.road_users) seen.push_back(user.x);
            return draw(camera, map_from_camera, conditions);
        };
        write_synthetic_recording(request, small_town(), note_users, nullptr);
        return seen;
    };
    const auto begin = places(5);
    auto whole = places(0);
    ASSERT_GT(whole.size(), begin.size());
    whole.resize(begin.size());
    EXPECT_EQ(whole, begin);
}

/** Frames of a preset's route. */
std::size_t frames_of(fild::Preset preset)
{
    const auto options = options_of(preset);
    EXPECT_NO_THROW(options.check());
    return plan_route(options.route, options.town.street_grid(), 1).size();
}

TEST(SyntheticOptions, PresetsHaveTheirSize)
{
    EXPECT_LT(frames_of(fild::Preset::tiny), 100U);
    EXPECT_NEAR(static_cast<double>(frames_of(fild::Preset::demo)), 420, 20);
    EXPECT_NEAR(static_cast<double>(frames_of(fild::Preset::hard)), 420, 20);
    EXPECT_GT(frames_of(fild::Preset::large), 2000U);
}

TEST(SyntheticOptions, OnlyThePresetHardIsHard)
{
    for (const auto preset : {fild::Preset::tiny, fild::Preset::demo, fild::Preset::large})
    {
        const auto options = options_of(preset);
        EXPECT_EQ(options.route.lap_offset_m, 0);
        EXPECT_EQ(options.route.lap_view_deg, 0);
        EXPECT_EQ(options.conditions.occluders, 0);
        EXPECT_EQ(options.conditions.season_change, 0);
        EXPECT_EQ(options.town.look_alike_variation, 0);
    }
    const auto hard = options_of(fild::Preset::hard);
    EXPECT_GT(hard.route.lap_offset_m, 2);
    EXPECT_GE(hard.route.lap_view_deg, 20);
    EXPECT_GT(hard.conditions.occluders, 0);
    EXPECT_GT(hard.conditions.season_change, 0);
    EXPECT_GT(hard.town.look_alike_variation, 0);
}

TEST(SyntheticOptions, StandInTheReadme)
{
    const auto readme = read_text(FILD_SOURCE_DIR "/apps/synthetic-rawlog/README.md");
    fild::TSyntheticOptions options;
    for (const auto& [section, of_section] : options.sections())
    {
        EXPECT_THAT(readme, HasSubstr("| **[" + section + "]** |"));
        for (const auto& [key, value] : of_section->values())
            EXPECT_THAT(readme, HasSubstr("`" + key + "`")) << "[" << section << "]";
    }
}

std::map<std::string, std::string> files_made_with(std::size_t helpers, SensorKind sensor)
{
    const TemporaryFolder folder;
    write_synthetic_recording(small_request(folder, sensor),
                              small_town(),
                              draw,
                              nullptr,
                              {helpers, [] { return fild::DrawView(draw); }});
    return contents(folder);
}

TEST(SyntheticRecording, IsTheSameHoweverManyThreadsDraw)
{
    for (const auto sensor : {SensorKind::stereo, SensorKind::rgbd})
    {
        const auto alone = files_made_with(0, sensor);
        EXPECT_GT(alone.size(), 3U);
        for (const std::size_t helpers : {1U, 2U, 100U})
            EXPECT_EQ(files_made_with(helpers, sensor), alone) << helpers << " helpers";
    }
}

TEST(SyntheticRecording, IsDrawnByEachThreadInTurn)
{
    const TemporaryFolder folder;
    const auto request = small_request(folder, SensorKind::mono);
    std::atomic<std::size_t> own{0};
    std::atomic<std::size_t> helped{0};
    const auto counted = [](std::atomic<std::size_t>& count)
    {
        return [&count](const auto& camera, const auto& pose, const auto& conditions)
        {
            ++count;
            return draw(camera, pose, conditions);
        };
    };
    const auto made = write_synthetic_recording(
        request, small_town(), counted(own), nullptr, {1, [&] {
                                                           return fild::DrawView(counted(helped));
                                                       }});
    EXPECT_EQ(own, (made.frames + 1) / 2);
    EXPECT_EQ(helped, made.frames / 2);
}

TEST(SyntheticRecording, EndsWithWhatAThreadThrows)
{
    const TemporaryFolder folder;
    const auto request = small_request(folder, SensorKind::mono);
    const auto fail = [](const auto&, const auto&, const auto&) -> fild::RenderedView
    { throw std::runtime_error("out of paint"); };
    EXPECT_EQ(message_of<std::runtime_error>(
                  [&]
                  {
                      write_synthetic_recording(
                          request, small_town(), draw, nullptr, {2, [&] {
                                                                     return fild::DrawView(fail);
                                                                 }});
                  }),
              "out of paint");
    EXPECT_FALSE(fs::exists(request.rawlog_path));
}

}  // namespace
