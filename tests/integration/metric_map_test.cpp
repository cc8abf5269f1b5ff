// SPDX-License-Identifier: BSD-3-Clause
// rawlog-loop-closure from stereo pairs and depth images to the files of an optimised map.
#include "drawn_drive.h"
#include "fild/core/geodetic.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/synthetic/synthetic_options.h"
#include "fild/synthetic/synthetic_recording.h"
#include "fild/synthetic/town.h"
#include "frames_csv.h"
#include "rawlog/drawn_rawlog.h"
#include "run_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>

namespace
{
using fild::testing::Finished;
using fild::testing::lines_of;
using fild::testing::Objects;
using fild::testing::read_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kConfig =
    "[global_descriptor]\nmodel_file = " FILD_TINY_NETWORK
    "\nlayers = map\ninput_width = 4\ninput_height = 4\npooling = grid\n"
    "[index]\ndelay_seconds = 5\ncandidates = 16\n"
    "[hashing]\nratio = 0.87\nmutual_check = true\n"
    "[verification]\nmethod = magsac\n"
    "[consistency]\nconsecutive_frames = 1\n"
    "[render]\nenabled = false\n[report]\nwrite_html = false\n";

const std::vector<std::string> kMapFiles = {"map.simplemap",
                                            "poses.csv",
                                            "poses.g2o",
                                            "poses.graph",
                                            "trajectory_input.tum",
                                            "trajectory_optimized.tum"};

// The wall of drawn_drive.h, kDepth metres to the left of a robot that drives along it twice.
constexpr std::size_t kFramesPerLap = 8;
constexpr double kFocal = 300;
constexpr double kDepth = 6;
constexpr double kStep = 80 / kFocal * kDepth;
constexpr double kShift = 7 / kFocal * kDepth;  // forward, of the second lap
constexpr double kDrop = 4 / kFocal * kDepth;  // downward
constexpr int kDisparity = 20;
constexpr double kBaseline = kDisparity / kFocal * kDepth;

constexpr fild::GeodeticPosition kStart{36.7, -4.5, 50};

enum class Sensor
{
    stereo,
    depth
};

mrpt::img::CImage to_image(const cv::Mat& pixels)
{
    return {pixels, mrpt::img::DEEP_COPY};
}

mrpt::img::TCamera camera()
{
    return fild::mrpt_camera_from(
        {kFocal, kFocal, 159.5, 119.5, 320, 240, fild::LensModel::none, {}});
}

mrpt::obs::CObservationStereoImages::Ptr stereo_pair(const cv::Mat& left, const cv::Mat& right)
{
    auto pair = mrpt::obs::CObservationStereoImages::Create();
    pair->imageLeft = to_image(left);
    pair->imageRight = to_image(right);
    pair->hasImageRight = true;
    pair->leftCamera = pair->rightCamera = camera();
    pair->cameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0, 0, 1, 0, 0, -CV_PI / 2));
    pair->rightCameraPose =
        mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(kBaseline, 0, 0, 0, 0, 0));
    return pair;
}

mrpt::obs::CObservation3DRangeScan::Ptr range_scan(const cv::Mat& image)
{
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->hasIntensityImage = scan->hasRangeImage = true;
    scan->intensityImage = to_image(image);
    scan->cameraParams = scan->cameraParamsIntensity = camera();
    scan->sensorPose = mrpt::poses::CPose3D(0, 0, 1, CV_PI / 2, 0, 0);
    scan->rangeUnits = 0.001F;
    scan->rangeImage_setSize(image.rows, image.cols);
    scan->rangeImage.fill(static_cast<std::uint16_t>(1000 * kDepth));
    return scan;
}

/** A recording of the two laps; `change` sees each camera observation. */
struct WallDrive
{
    Sensor sensor = Sensor::stereo;
    bool odometry = true;
    double odometry_unit = 1;  ///< metres of what it calls one
    std::size_t frames = 2 * kFramesPerLap;
    bool second_wall = false;  ///< the second lap is somewhere else
    bool gps = false;  ///< a receiver with RTK, on the way to the north
    std::function<void(mrpt::obs::CObservation&)> change = [](mrpt::obs::CObservation&) {};

    Objects objects() const
    {
        Objects objects;
        const cv::Size size(80 * static_cast<int>(kFramesPerLap) + 400, 260);
        const auto first = fild::testing::draw_wall(size.width, size.height, 1);
        const auto second =
            second_wall ? fild::testing::draw_wall(size.width, size.height, 2) : first;
        for (std::size_t i = 0; i < frames; ++i)
        {
            const bool is_second = i >= kFramesPerLap;
            const auto& wall = is_second ? second : first;
            const cv::Rect left(80 * static_cast<int>(i % kFramesPerLap) + (is_second ? 7 : 0),
                                is_second ? 4 : 0,
                                320,
                                240);
            const auto image = wall(left).clone();
            mrpt::obs::CObservation::Ptr seen;
            if (sensor == Sensor::stereo)
                seen = stereo_pair(image, wall(left + cv::Point(kDisparity, 0)).clone());
            else
                seen = range_scan(image);
            seen->timestamp = mrpt::Clock::fromDouble(static_cast<double>(i));
            seen->sensorLabel = "CAMERA1";
            change(*seen);
            if (odometry) objects.push_back(reading(i, odometry_unit));
            if (gps) objects.push_back(fix(i));
            objects.push_back(seen);
        }
        return objects;
    }

 private:
    static double way(std::size_t frame)
    {
        return kStep * static_cast<double>(frame % kFramesPerLap) +
               (frame >= kFramesPerLap ? kShift : 0);
    }

    static mrpt::obs::CObservation::Ptr fix(std::size_t frame)
    {
        const auto place = fild::EastNorthUp(kStart).place_of({0, way(frame), 0});
        mrpt::obs::gnss::Message_NMEA_GGA gga;
        gga.fields.latitude_degrees = place.latitude_deg;
        gga.fields.longitude_degrees = place.longitude_deg;
        gga.fields.altitude_meters = place.height_m;
        gga.fields.fix_quality = 4;
        auto gps = mrpt::obs::CObservationGPS::Create();
        gps->sensorLabel = "GPS";
        gps->timestamp = mrpt::Clock::fromDouble(static_cast<double>(frame));
        gps->setMsg(gga);
        return gps;
    }

    static mrpt::obs::CObservationOdometry::Ptr reading(std::size_t frame, double unit)
    {
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = "ODOMETRY";
        odometry->timestamp = mrpt::Clock::fromDouble(static_cast<double>(frame));
        odometry->odometry = {way(frame) / unit, 0, 0};
        return odometry;
    }
};

class MetricMap : public ::testing::Test
{
 protected:
    MetricMap() { fild::testing::write_text(path("run.ini"), kConfig); }

    std::string path(const std::string& name) const { return folder_.path(name); }

    void write(const WallDrive& drive) const
    {
        fild::testing::write_gz(path("run.rawlog"), drive.objects());
    }

    Finished run(const std::string& more = "") const
    {
        return fild::testing::run_command("'" RAWLOG_LOOP_CLOSURE "' --quiet --rawlog '" +
                                          path("run.rawlog") + "' --config '" + path("run.ini") +
                                          "' --output '" + path("out") + "' " + more);
    }

    void run_well(const std::string& more = "") const
    {
        const auto finished = run(more);
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
    }

    std::string result(const std::string& name) const { return read_text(path("out/" + name)); }

    bool has(const std::string& name) const { return fs::exists(path("out/" + name)); }

    nlohmann::json map() const { return nlohmann::json::parse(result("summary.json"))["map"]; }

    std::string notes() const { return map()["notes"].dump(); }

    /** Rows of loops.csv by name of the column. */
    std::vector<std::map<std::string, std::string>> loops() const
    {
        std::vector<std::map<std::string, std::string>> rows;
        const auto lines = lines_of(result("loops.csv"));
        const auto names = fields_of(lines.at(0));
        for (std::size_t i = 1; i < lines.size(); ++i)
        {
            const auto fields = fields_of(lines[i]);
            EXPECT_EQ(fields.size(), names.size());
            rows.emplace_back();
            for (std::size_t k = 0; k < fields.size(); ++k) rows.back()[names[k]] = fields[k];
        }
        return rows;
    }

 private:
    static std::vector<std::string> fields_of(const std::string& line)
    {
        std::vector<std::string> fields(1);
        for (const char c : line)
            if (c == ',')
                fields.emplace_back();
            else
                fields.back() += c;
        return fields;
    }

    fild::testing::TemporaryFolder folder_;
};

TEST_F(MetricMap, IsMadeFromStereoPairsAndFromDepthImages)
{
    for (const auto sensor : {Sensor::stereo, Sensor::depth})
    {
        WallDrive drive;
        drive.sensor = sensor;
        write(drive);
        run_well();
        for (const auto& name : kMapFiles) EXPECT_TRUE(has(name)) << name;
        ASSERT_EQ(loops().size(), kFramesPerLap);
        for (const auto& loop : loops())
        {
            EXPECT_NEAR(std::stod(loop.at("x")), kShift, 0.03);
            EXPECT_NEAR(std::stod(loop.at("y")), 0, 0.05);
            EXPECT_NEAR(std::stod(loop.at("z")), -kDrop, 0.03);
            EXPECT_NEAR(std::stod(loop.at("yaw_deg")), 0, 0.5);
            EXPECT_GT(std::stod(loop.at("sigma_x")), 0);
            EXPECT_EQ(loop.at("edge"), "used");
            EXPECT_EQ(std::stod(loop.at("weight")), 1);
            EXPECT_EQ(loop.at("depth_source"), sensor == Sensor::stereo ? "stereo" : "depth_image");
        }
        EXPECT_EQ(map()["trajectory_source"], "CObservationOdometry 'ODOMETRY', images");
        EXPECT_EQ(map()["loop_edges"], kFramesPerLap);
        EXPECT_EQ(map()["nodes"], 2 * kFramesPerLap);
    }
}

TEST_F(MetricMap, IsGeoReferencedByGps)
{
    WallDrive drive;
    drive.gps = true;
    write(drive);
    run_well();
    EXPECT_EQ(map()["trajectory"], "combined");
    EXPECT_NEAR(map()["origin"]["latitude_deg"], kStart.latitude_deg, 1e-6);
    EXPECT_NEAR(map()["origin"]["longitude_deg"], kStart.longitude_deg, 1e-6);
    ASSERT_EQ(map()["sources"].size(), 3U);
    EXPECT_EQ(map()["sources"][2]["kind"], "gps");
    EXPECT_EQ(map()["sources"][2]["factors"], 2 * kFramesPerLap);
    EXPECT_EQ(map()["sources"][2]["left_out"], "");
    EXPECT_EQ(notes(), "[]");
    double seconds = 0;
    double x = 0;
    double y = 0;
    std::istringstream(lines_of(result("trajectory_optimized.tum")).at(5)) >> seconds >> x >> y;
    EXPECT_NEAR(x, 0, 0.1);
    EXPECT_NEAR(y, 5 * kStep, 0.1) << "to the north";
    EXPECT_THAT(result("track.kml"),
                AllOf(HasSubstr("before the loops"), HasSubstr("-4.5000"), HasSubstr("36.7000")));
    run_well("--set graph.motion_sources=odometry,vision");
    EXPECT_FALSE(has("track.kml")) << "nothing of the run before";
    EXPECT_TRUE(map()["origin"].is_null());
}

TEST_F(MetricMap, SaysThatTheCamerasPoseIsWrong)
{
    WallDrive drive;
    write(drive);
    run_well();
    EXPECT_EQ(notes(), "[]") << "nothing is wrong";
    const auto on_robot = [](const mrpt::poses::CPose3D& pose)
    {
        return [pose](mrpt::obs::CObservation& seen)
        {
            dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen).cameraPose =
                mrpt::poses::CPose3DQuat(pose);
        };
    };
    drive.change = on_robot({0, 0, 1, CV_PI / 2, 0, 0});  // x looks left, as a robot's axes do
    write(drive);
    run_well();
    EXPECT_THAT(notes(),
                AllOf(HasSubstr("90 degrees off"), HasSubstr("yaw -90, pitch 0, roll -90")));
    drive.change = on_robot({0, 0, 1, CV_PI / 2, 0, -CV_PI / 2});  // looks back
    write(drive);
    run_well();
    EXPECT_THAT(notes(), HasSubstr("the camera's pose on the robot is wrong"));
}

TEST_F(MetricMap, SaysThatDepthsAndOdometryContradictEachOther)
{
    WallDrive drive;
    drive.change = [](mrpt::obs::CObservation& seen)
    { dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen).rightCameraPose.x() *= 0.1; };
    write(drive);
    run_well("--set depth.min_depth_m=0.01");
    EXPECT_THAT(notes(), HasSubstr("are 0.1"));
    drive.change = [](mrpt::obs::CObservation&) {};
    drive.odometry_unit = 0.1;
    write(drive);
    run_well();
    EXPECT_THAT(notes(), HasSubstr("are 0.1 times as long"));
    drive.odometry_unit = 0.001;  // millimetres
    write(drive);
    run_well();
    EXPECT_THAT(notes(), AllOf(HasSubstr("was reset, or jumped"), HasSubstr("in metres?")));
    drive.odometry_unit = 1e9;  // frozen
    write(drive);
    run_well();
    EXPECT_THAT(
        notes(),
        HasSubstr("'ODOMETRY' has no part in the map: it says that the robot hardly moves"));
    EXPECT_THAT(notes(), HasSubstr("times as long"));
}

/** The stereo pairs as two cameras record them. */
struct SplitDrive
{
    double later = 0.004;  ///< the right image's time stamp
    std::function<void(mrpt::obs::CObservationImage&)> change = [](auto&) {};

    Objects objects(const WallDrive& drive = {}) const
    {
        Objects objects;
        for (const auto& object : drive.objects())
        {
            const auto pair =
                std::dynamic_pointer_cast<mrpt::obs::CObservationStereoImages>(object);
            if (!pair)
            {
                objects.push_back(object);
                continue;
            }
            const mrpt::poses::CPose3D left_pose(pair->cameraPose);
            add(*pair, "CAMERA_LEFT", pair->imageLeft, left_pose, 0, objects);
            add(*pair,
                "CAMERA_RIGHT",
                pair->imageRight,
                left_pose + mrpt::poses::CPose3D(pair->rightCameraPose),
                later,
                objects);
        }
        return objects;
    }

 private:
    void add(const mrpt::obs::CObservationStereoImages& pair,
             const std::string& label,
             const mrpt::img::CImage& pixels,
             const mrpt::poses::CPose3D& pose,
             double seconds,
             Objects& objects) const
    {
        auto image = mrpt::obs::CObservationImage::Create();
        image->sensorLabel = label;
        image->image = pixels;
        image->cameraParams = pair.leftCamera;
        image->cameraPose = pose;
        image->timestamp = mrpt::Clock::fromDouble(mrpt::Clock::toDouble(pair.timestamp) + seconds);
        change(*image);
        if (!image->sensorLabel.empty()) objects.push_back(image);
    }
};

/** Two cameras instead of the stereo camera. */
class TwoCameras : public MetricMap
{
 protected:
    void write(const SplitDrive& split, const WallDrive& drive = {}) const
    {
        fild::testing::write_gz(path("run.rawlog"), split.objects(drive));
    }

    nlohmann::json frames() const
    {
        return nlohmann::json::parse(result("summary.json"))["frames"];
    }

    /** Runs and gives the only note on the frames. */
    std::string note_of_run(const std::string& more = "") const
    {
        run_well(more);
        const auto notes = frames()["notes"];
        EXPECT_EQ(notes.size(), 1U) << notes;
        return notes.dump();
    }
};

TEST_F(TwoCameras, MakeTheMapOfAStereoCamera)
{
    for (const bool odometry : {true, false})
    {
        WallDrive drive;
        drive.odometry = odometry;
        write({}, drive);
        run_well();
        for (const auto& name : kMapFiles) EXPECT_TRUE(has(name)) << name;
        EXPECT_EQ(loops().size(), kFramesPerLap);
        EXPECT_EQ(map()["loop_edges"], kFramesPerLap);
        EXPECT_TRUE(frames()["notes"].empty()) << frames()["notes"];
        const auto pair = frames()["stereo_pair"];
        EXPECT_EQ(pair["left"], "CAMERA_LEFT");
        EXPECT_EQ(pair["right"], "CAMERA_RIGHT");
        EXPECT_EQ(pair["frames_with_right_image"], 2 * kFramesPerLap);
        EXPECT_EQ(pair["frames_without"], 0);
    }
}

TEST_F(TwoCameras, KeepTheFramesToTheLimit)
{
    write({});
    run_well("--max-frames 5");
    EXPECT_EQ(frames()["camera_frames"], 5);
    EXPECT_EQ(lines_of(result("frames.csv")).size(), 6U);
}

TEST_F(TwoCameras, StandAloneWhereThePairIsSwitchedOff)
{
    write({});
    EXPECT_THAT(note_of_run("--set input.stereo_labels=none"),
                HasSubstr("camera CAMERA_RIGHT was not looked at"));
    EXPECT_TRUE(frames()["stereo_pair"].is_null());
    EXPECT_EQ(map()["depth_sources"].count("stereo"), 0U);
}

TEST_F(TwoCameras, AreRefusedByNamesInTheWrongOrder)
{
    write({});
    const auto finished = run("--set input.stereo_labels=CAMERA_RIGHT,CAMERA_LEFT");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("set [input] stereo_labels = CAMERA_LEFT,CAMERA_RIGHT"));
}

TEST_F(TwoCameras, OneOfWhichStopsGiveFramesWithoutDepth)
{
    std::size_t rights = 0;
    SplitDrive split;
    split.change = [&](mrpt::obs::CObservationImage& image)
    {
        if (image.sensorLabel == "CAMERA_RIGHT" && ++rights > 4) image.sensorLabel.clear();
    };
    write(split);
    EXPECT_THAT(note_of_run(),
                AllOf(HasSubstr("camera 'CAMERA_RIGHT' ends"), HasSubstr("the last 12 frames")));
    EXPECT_EQ(frames()["stereo_pair"]["frames_without"], 12);
    EXPECT_EQ(map()["depth_defects"]["missing_right_image"], 12);
}

TEST_F(TwoCameras, OfWhichOneIsNotCalibratedStandAlone)
{
    SplitDrive split;
    split.change = [](mrpt::obs::CObservationImage& image)
    {
        if (image.sensorLabel == "CAMERA_RIGHT") image.cameraParams = {};
    };
    write(split);
    EXPECT_THAT(note_of_run(), HasSubstr("camera 'CAMERA_RIGHT' is not calibrated"));
}

TEST_F(TwoCameras, InOnePlaceStandAlone)
{
    SplitDrive split;
    split.change = [](mrpt::obs::CObservationImage& image)
    { image.cameraPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0, -CV_PI / 2); };
    write(split);
    EXPECT_THAT(note_of_run(), HasSubstr("'CAMERA_LEFT' and 'CAMERA_RIGHT' are in one place"));
}

TEST_F(TwoCameras, WhoseTimeStampsDifferTooMuchStandAlone)
{
    SplitDrive split;
    split.later = 0.05;
    write(split);
    const auto note = note_of_run();
    EXPECT_THAT(note, HasSubstr("set [input] stereo_tolerance_seconds = 0.06"));
    run_well("--set input.stereo_tolerance_seconds=0.06");
    EXPECT_EQ(map()["loop_edges"], kFramesPerLap);
}

TEST_F(TwoCameras, ThatAreSwappedBendNoMap)
{
    WallDrive drive;
    drive.change = [](mrpt::obs::CObservation& seen)
    {
        auto& pair = dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen);
        std::swap(pair.imageLeft, pair.imageRight);
    };
    write({}, drive);
    run_well();
    EXPECT_THAT(
        notes(),
        HasSubstr("are left and right image of cameras 'CAMERA_LEFT' and 'CAMERA_RIGHT' swapped"));
    EXPECT_EQ(map()["loop_edges"], 0);
}

TEST_F(MetricMap, SaysThatLeftAndRightMayBeSwapped)
{
    WallDrive drive;
    drive.change = [](mrpt::obs::CObservation& seen)
    {
        auto& pair = dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen);
        std::swap(pair.imageLeft, pair.imageRight);
    };
    write(drive);
    run_well();
    EXPECT_THAT(notes(), HasSubstr("left and right image swapped"));
}

TEST_F(MetricMap, DoesNotPrintWhatMrptMends)
{
    WallDrive drive;
    drive.sensor = Sensor::depth;
    drive.change = [](mrpt::obs::CObservation& seen)
    { dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(seen).cameraParams.ncols = 640; };
    write(drive);
    EXPECT_THAT(run().err, ::testing::Not(HasSubstr("autofixing")));
}

TEST_F(MetricMap, ComesBackThroughMrptsReaders)
{
    write(WallDrive());
    run_well();
    mrpt::graphs::CNetworkOfPoses3D graph;
    graph.loadFromTextFile(path("out/poses.graph"));
    EXPECT_EQ(graph.nodeCount(), 2 * kFramesPerLap);
    EXPECT_EQ(graph.edgeCount(), 2 * kFramesPerLap - 1 + kFramesPerLap);
    mrpt::maps::CSimpleMap keyframes;
    ASSERT_TRUE(keyframes.loadFromFile(path("out/map.simplemap")));
    EXPECT_EQ(keyframes.size(), 2 * kFramesPerLap);
    EXPECT_EQ(lines_of(result("trajectory_optimized.tum")).size(), 2 * kFramesPerLap);

    run_well("--set graph.graph_dimensions=2d --set graph.simple_map=false");
    mrpt::graphs::CNetworkOfPoses2D planar;
    planar.loadFromTextFile(path("out/poses.graph"));
    EXPECT_EQ(planar.nodeCount(), 2 * kFramesPerLap);
    EXPECT_FALSE(has("map.simplemap")) << "that of the run before is removed";

    run_well("--set graph.trajectory_format=kitti");
    EXPECT_EQ(lines_of(result("trajectory_optimized.kitti")).size(), 2 * kFramesPerLap);
    EXPECT_FALSE(has("trajectory_optimized.tum"));
}

TEST_F(MetricMap, HasTheSameBytesAgainAndWithTwoThreads)
{
    WallDrive drive;
    drive.odometry = false;
    write(drive);
    std::map<std::string, std::string> before;
    for (const std::string threads : {"1", "1", "2"})
    {
        run_well("--set runtime.num_threads=" + threads);
        for (const auto* name :
             {"frames.csv", "loops.csv", "poses.graph", "poses.g2o", "trajectory_optimized.tum"})
        {
            const auto [found, is_new] = before.emplace(name, result(name));
            EXPECT_TRUE(is_new || result(name) == found->second) << name;
        }
    }
}

/** What takes longest with the sanitizers. */
using MetricMapPictures = MetricMap;

TEST_F(MetricMapPictures, AreDrawn)
{
    write(WallDrive());
    run_well(
        "--set render.enabled=true --set render.match_pictures_3d=true "
        "--set render.camera_images=true --set report.write_html=true");
    for (const auto* name : {"map_top.png", "map_perspective.png"})
        EXPECT_EQ(cv::imread(path(std::string("out/") + name)).size(), cv::Size(1600, 1000));
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(path("out/map.3Dscene")));
    EXPECT_TRUE(scene.getByName("loops"));
    EXPECT_FALSE(scene.getByName("ground truth"));
    EXPECT_TRUE(has("matches/8_0.jpg"));
    EXPECT_EQ(cv::imread(path("out/matches/8_0_3d.jpg")).cols, 1400);
    EXPECT_THAT(result("report.html"), HasSubstr("from above"));

    run_well("--set render.enabled=true --set render.write_map_pictures=false");
    for (const auto* name :
         {"map_top.png", "map_perspective.png", "map.3Dscene", "matches/8_0_3d.jpg"})
        EXPECT_FALSE(has(name)) << name << " of the run before is removed";
    EXPECT_TRUE(has("matches/8_0.jpg"));
    run_well();
    EXPECT_FALSE(has("matches/8_0.jpg")) << "nothing is drawn";
}

/** Where the robot of a WallDrive truly was, as lines of a TUM file; every other frame is said to
 *  be `aside` metres to the left of that, the frames between them to the right. */
std::string true_path(double aside)
{
    std::ostringstream text;
    for (std::size_t i = 0; i < 2 * kFramesPerLap; ++i)
    {
        const bool is_second = i >= kFramesPerLap;
        const double x = kStep * static_cast<double>(i % kFramesPerLap);
        text << i << " " << x + (is_second ? kShift : 0) << " " << (i % 2 == 0 ? aside : -aside)
             << " " << (is_second ? -kDrop : 0) << " 0 0 0 1\n";
    }
    return text.str();
}

/** The number that follows `words`; NaN without it. */
double number_after(const std::string& words, const std::string& text)
{
    const auto at = text.find(words);
    if (at == std::string::npos) return std::nan("");
    return std::stod(text.substr(at + words.size()));
}

TEST_F(MetricMapPictures, AreComparedWithTheTruth)
{
    write(WallDrive());
    constexpr double kAside = 0.1;
    fild::testing::write_text(path("truth.tum"), true_path(kAside));
    const auto finished = run("--ground-truth '" + path("truth.tum") +
                              "' --protocol radius:1 --set render.enabled=true "
                              "--set report.write_html=true");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NEAR(number_after("ATE of trajectory_optimized ", finished.out), kAside, 0.01);
    EXPECT_THAT(result("report.html"), HasSubstr("truth.tum"));
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(path("out/map.3Dscene")));
    EXPECT_TRUE(scene.getByName("ground truth"));

    fild::testing::write_text(path("loops.txt"), "8 0\n9 1\n10 3\n");
    const auto labelled = run("--ground-truth '" + path("loops.txt") + "'");
    EXPECT_THAT(labelled.out,
                HasSubstr("2 right, 6 wrong, 0 doubtful, 1 missed, precision 0.250, recall 0.667"));
}

TEST_F(MetricMap, IsKeptWhenTheTruthCannotBeRead)
{
    write(WallDrive());
    const auto finished = run("--ground-truth '" + path("none.tum") + "'");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("none.tum"));
    EXPECT_FALSE(has("frames.csv")) << "said before the work begins";

    fild::testing::write_text(path("bad.tum"), "0 0 0 0 0 0 0 1\n1 2 3 and so on\n");
    const auto late = run("--ground-truth '" + path("bad.tum") + "' --protocol radius:1");
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_THAT(late.err, HasSubstr("bad.tum"));
    for (const auto& name : kMapFiles) EXPECT_TRUE(has(name)) << name;
    EXPECT_EQ(run("--protocol radius:1").exit_code, 2) << "without ground truth";
}

TEST_F(MetricMap, KnowsAtItsStartWhichProtocolTheTruthNeeds)
{
    write(WallDrive());
    run_well();
    fs::copy(path("out/trajectory_optimized.tum"), path("truth.tum"));
    const auto truth = "--ground-truth '" + path("truth.tum") + "'";
    const auto finished = run(truth + " --set report.write_html=true");
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(result("report.html"),
                AllOf(HasSubstr("radius:5"), HasSubstr("at least 5 s older")));  // the delay
    fs::remove_all(path("out"));
    EXPECT_EQ(run(truth + " --protocol exact").exit_code, 2);
    EXPECT_FALSE(has("frames.csv")) << "said before the work begins";
}

TEST_F(MetricMap, ChangesNothingOfWhatTheDetectorSays)
{
    write(WallDrive());
    const auto without_last_column = [&]
    {
        std::string text;
        for (const auto& line : lines_of(result("frames.csv")))
            text += line.substr(0, line.rfind(',')) + "\n";
        return text;
    };
    run_well();
    const auto with_poses = without_last_column();
    run_well("--set relative_pose.enabled=false");
    EXPECT_EQ(without_last_column(), with_poses);
    EXPECT_EQ(map()["loops_withheld"]["not_enabled"], kFramesPerLap);
    EXPECT_EQ(map()["depth_sources"]["none"], 2 * kFramesPerLap);
}

TEST_F(MetricMap, TakesLoopsAcrossABreakOfWhatTheImagesTell)
{
    WallDrive drive;
    drive.odometry = false;
    for (const auto sensor : {Sensor::stereo, Sensor::depth})
    {
        drive.sensor = sensor;
        write(drive);
        run_well();  // between the laps the robot is carried back: nothing in common
        EXPECT_EQ(map()["trajectory"], "vision");
        EXPECT_EQ(map()["resets"], 1);
        EXPECT_EQ(map()["nodes"], 2 * kFramesPerLap);
        EXPECT_EQ(map()["parts"], (std::vector<std::size_t>{2 * kFramesPerLap}));
    }
    drive.second_wall = true;
    write(drive);
    run_well();
    EXPECT_EQ(map()["parts"], (std::vector<std::size_t>{kFramesPerLap, kFramesPerLap}));
    EXPECT_THAT(notes(), HasSubstr("in 2 parts"));
    mrpt::graphs::CNetworkOfPoses3D graph;
    graph.loadFromTextFile(path("out/poses.graph"));
    EXPECT_EQ(graph.nodeCount(), kFramesPerLap);
}

TEST_F(MetricMap, SaysThatTheCameraIsNotCalibrated)
{
    WallDrive drive;
    drive.change = [](mrpt::obs::CObservation& seen)
    {
        auto& pair = dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen);
        pair.leftCamera = pair.rightCamera = mrpt::img::TCamera();
    };
    write(drive);
    run_well();
    EXPECT_EQ(map()["loops_withheld"]["not_calibrated"], kFramesPerLap);
    EXPECT_EQ(map()["depth_defects"]["not_calibrated"], 2 * kFramesPerLap);
    EXPECT_THAT(notes(), HasSubstr("camera_parameters"));
    for (const auto& loop : loops())
    {
        EXPECT_EQ(loop.at("edge"), "not_calibrated");
        EXPECT_EQ(loop.at("x"), "");
        EXPECT_EQ(loop.at("weight"), "");
    }
    EXPECT_TRUE(has("poses.graph")) << "the odometry is there all the same";
    run_well("--set 'input.camera_parameters=300 300 159.5 119.5 320 240'");
    EXPECT_EQ(map()["loop_edges"], kFramesPerLap);
}

TEST_F(MetricMap, BearsBaselinesThatCannotBe)
{
    for (const double baseline : {0.0, -kBaseline})
    {
        WallDrive drive;
        drive.odometry = false;
        drive.change = [&](mrpt::obs::CObservation& seen)
        {
            dynamic_cast<mrpt::obs::CObservationStereoImages&>(seen).rightCameraPose =
                mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(baseline, 0, 0, 0, 0, 0));
        };
        write(drive);
        run_well();
        EXPECT_EQ(map()["depth_defects"]["unusable_baseline"], 2 * kFramesPerLap);
        EXPECT_EQ(map()["loops_withheld"]["no_odometry"], kFramesPerLap);
        EXPECT_THAT(notes(), HasSubstr("no map"));
        for (const auto& name : kMapFiles) EXPECT_FALSE(has(name)) << name;
    }
}

TEST_F(MetricMap, BearsDepthImagesWithoutDepth)
{
    WallDrive drive;
    drive.sensor = Sensor::depth;
    drive.odometry = false;
    drive.change = [](mrpt::obs::CObservation& seen)
    { dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(seen).rangeImage.fill(0); };
    write(drive);
    run_well();
    EXPECT_EQ(loops().size(), kFramesPerLap);
    EXPECT_EQ(map()["trajectory"], "none");
    EXPECT_EQ(map()["loops_withheld"]["no_odometry"], kFramesPerLap);
}

TEST_F(MetricMap, IsASingleKeyframeOrNone)
{
    write(WallDrive());
    run_well();
    ASSERT_TRUE(has("poses.graph"));
    run_well("--max-frames 1");
    EXPECT_FALSE(has("poses.graph")) << "that of the run before is removed";
    EXPECT_TRUE(has("map.simplemap"));
    EXPECT_EQ(map()["nodes"], 1);
    EXPECT_THAT(notes(), HasSubstr("single keyframe"));
}

TEST_F(MetricMap, HasNoKittiFileWhereFramesHaveNoPose)
{
    WallDrive drive;
    auto objects = drive.objects();
    for (const int reading : {4, 2, 0}) objects.erase(objects.begin() + reading);
    fild::testing::write_gz(path("run.rawlog"), objects);
    run_well("--set graph.trajectory_format=kitti --set graph.motion_sources=odometry");
    EXPECT_FALSE(has("trajectory_input.kitti"));
    EXPECT_TRUE(has("poses.graph"));
    EXPECT_THAT(notes(), HasSubstr("trajectory_format = tum"));
    EXPECT_GE(map()["loops_withheld"]["frame_without_pose"], 1);
    EXPECT_GE(map()["frames_without_pose"], 1);
}

/** A drive of two laps round a small block of the synthetic town. */
class TownMap : public MetricMap
{
 protected:
    void draw(fild::SensorKind sensor, bool odometry) const
    {
        fild::SyntheticRequest request;
        request.rawlog_path = path("run.rawlog");
        request.options = fild::options_of(fild::Preset::tiny);
        request.options.sensors.sensor = sensor;
        if (sensor == fild::SensorKind::pair)
        {
            request.options.sensors.toe_in_deg = 2;
            request.options.sensors.lens_k1 = -0.28;
            request.options.sensors.lens_k2 = 0.07;
        }
        request.options.route.frames_per_second = odometry ? 1.5 : 3;
        if (!odometry)
        {
            request.options.sensors.odometry = fild::OdometryKind::none;
            request.options.sensors.width = 640;
            request.options.sensors.height = 480;
            request.options.route.max_frames = 45;  // round two corners
        }
        fild::Town town(request.options.town);
        write_synthetic_recording(request,
                                  town.grid(),
                                  [&](const auto& camera, const auto& pose, const auto& conditions)
                                  { return town.draw(camera, pose, conditions); },
                                  {});
    }

    std::size_t frames() const { return lines_of(result("frames.csv")).size() - 1; }
};

TEST_F(TownMap, OfAStereoCameraIsTakenByGraphSlam)
{
    draw(fild::SensorKind::stereo, true);
    run_well();
    EXPECT_GE(map()["loop_edges"].get<std::size_t>(), 10U);
    EXPECT_EQ(map()["parts"].size(), 1U);
    EXPECT_LT(map()["chi2_after"].get<double>(), map()["chi2_before"].get<double>());
    if (fild::testing::run_command("command -v graph-slam").exit_code != 0)
        GTEST_SKIP() << "no graph-slam; it is in Debian's mrpt-apps";
    const auto finished =
        fild::testing::run_command("graph-slam --3d --levmarq -i '" + path("out/poses.graph") +
                                   "' -o '" + path("slam.graph") + "'");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    mrpt::graphs::CNetworkOfPoses3D graph;
    graph.loadFromTextFile(path("slam.graph"));
    EXPECT_EQ(graph.nodeCount(), map()["nodes"].get<std::size_t>());
}

/** Distance between two poses of a file in TUM's format. */
double metres_between(const std::string& text, std::size_t from, std::size_t to)
{
    const auto lines = lines_of(text);
    const auto position = [&](std::size_t i)
    {
        std::istringstream words(lines.at(i));
        double seconds = 0;
        std::array<double, 3> p{};
        words >> seconds >> p[0] >> p[1] >> p[2];
        return p;
    };
    const auto a = position(from);
    const auto b = position(to);
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

TEST_F(TownMap, OfTwoBentCamerasThatAreTurnedInNeedsNoOdometry)
{
    draw(fild::SensorKind::pair, false);
    run_well();
    const auto pair = nlohmann::json::parse(result("summary.json"))["frames"]["stereo_pair"];
    EXPECT_EQ(pair["frames_with_right_image"], frames());
    EXPECT_EQ(map()["trajectory"], "vision");
    EXPECT_EQ(map()["parts"], (std::vector<std::size_t>{frames()}));
    const auto last = frames() - 1;
    const double truth = metres_between(read_text(path("run.gt.tum")), 0, last);
    const double found = metres_between(result("trajectory_optimized.tum"), 0, last);
    EXPECT_NEAR(found / truth, 1, 0.02) << found << " m of " << truth;
}

TEST_F(TownMap, OfADepthCameraNeedsNoOdometry)
{
    draw(fild::SensorKind::rgbd, false);
    run_well();
    EXPECT_EQ(map()["trajectory"], "vision");
    EXPECT_EQ(map()["resets"], 0);
    EXPECT_EQ(map()["nodes"], frames());
    EXPECT_EQ(map()["parts"], (std::vector<std::size_t>{frames()}));
    EXPECT_EQ(map()["odometry_edges"], frames() - 1);
}

}  // namespace
