// SPDX-License-Identifier: BSD-3-Clause
#include "corpus.h"

#include "drawn_drive.h"
#include "evaluation/mat_file.h"
#include "fild/results/candidates_csv.h"
#include "fild/results/costs_csv.h"
#include "fild/results/loops_csv.h"
#include "fild/results/poses_csv.h"
#include "rawlog/drawn_rawlog.h"

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/gnss_messages_ascii_nmea.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>

namespace fild::fuzz
{
namespace
{
using testing::draw_wall;
using testing::image_observation;
using testing::Objects;
using testing::read_text;
using namespace mrpt::obs;

mrpt::img::CImage wall(int seed)
{
    return mrpt::img::CImage(draw_wall(64, 48, static_cast<unsigned>(seed)), mrpt::img::DEEP_COPY);
}

CObservation::Ptr at(CObservation::Ptr observation, double seconds, const std::string& label)
{
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->sensorLabel = label;
    return observation;
}

CObservation::Ptr stereo(int seed)
{
    auto pair = CObservationStereoImages::Create();
    pair->imageLeft = wall(seed);
    pair->imageRight = wall(seed);
    pair->hasImageRight = true;
    pair->leftCamera.setIntrinsicParamsFromValues(60, 60, 32, 24);
    pair->leftCamera.ncols = 64;
    pair->leftCamera.nrows = 48;
    pair->rightCamera = pair->leftCamera;
    pair->rightCameraPose.x(0.1);
    return at(pair, seed, "STEREO");
}

CObservation::Ptr range_scan(int seed)
{
    auto scan = CObservation3DRangeScan::Create();
    scan->hasIntensityImage = true;
    scan->intensityImage = wall(seed);
    scan->hasRangeImage = true;
    scan->rangeUnits = 0.001F;
    scan->rangeImage.setSize(48, 64);
    scan->rangeImage.fill(2000);
    scan->hasPoints3D = true;
    scan->resizePoints3DVectors(20);
    scan->cameraParams.setIntrinsicParamsFromValues(60, 60, 32, 24);
    scan->cameraParams.ncols = 64;
    scan->cameraParams.nrows = 48;
    scan->cameraParamsIntensity = scan->cameraParams;
    return at(scan, seed, "RGBD");
}

CObservation::Ptr odometry(int seed)
{
    auto wheels = CObservationOdometry::Create();
    wheels->odometry = mrpt::poses::CPose2D(seed, 0.1 * seed, 0.01 * seed);
    return at(wheels, seed, "WHEELS");
}

CObservation::Ptr gps(int seed)
{
    auto receiver = CObservationGPS::Create();
    gnss::Message_NMEA_GGA fix;
    fix.fields.latitude_degrees = 36 + 1e-5 * seed;
    fix.fields.fix_quality = 1;
    receiver->setMsg(fix);
    return at(receiver, seed, "GPS");
}

CObservation::Ptr laser(int seed)
{
    auto scan = CObservation2DRangeScan::Create();
    scan->resizeScan(30);
    return at(scan, seed, "LASER");
}

CObservation::Ptr velodyne(int seed)
{
    auto scan = CObservationVelodyneScan::Create();
    scan->scan_packets.resize(1);
    return at(scan, seed, "VELODYNE");
}

CActionCollection::Ptr step()
{
    auto actions = CActionCollection::Create();
    CActionRobotMovement2D planar;
    planar.computeFromOdometry(mrpt::poses::CPose2D(1, 0, 0.1), {});
    actions->insert(planar);
    CActionRobotMovement3D spatial;
    spatial.computeFromOdometry(mrpt::poses::CPose3D(1, 0, 0, 0.1, 0, 0), {});
    actions->insert(spatial);
    return actions;
}

Objects observations(CObservation::Ptr (*camera)(int))
{
    Objects objects;
    for (int i = 0; i < 4; ++i)
        for (auto* each : {camera, odometry, gps, laser}) objects.push_back(each(i));
    objects.push_back(velodyne(4));
    objects.push_back(at(CObservationIMU::Create(), 4, "IMU"));
    objects.push_back(at(CObservationRobotPose::Create(), 4, "MOCAP"));
    objects.push_back(camera(5));
    return objects;
}

CObservation::Ptr mono(int seed)
{
    return image_observation(draw_wall(64, 48, static_cast<unsigned>(seed)), seed);
}

Objects actions_and_frames()
{
    Objects objects;
    for (int i = 0; i < 4; ++i)
    {
        objects.push_back(step());
        auto frame = CSensoryFrame::Create();
        frame->insert(stereo(i));
        frame->insert(laser(i));
        objects.push_back(frame);
    }
    return objects;
}

Objects one_rawlog_object()
{
    auto rawlog = CRawlog::Create();
    for (const auto& each : observations(mono)) rawlog->insert(each);
    return {rawlog};
}

Sample rawlog_of(const std::string& name, const Objects& objects, const std::string& folder)
{
    Sample sample{name, "", {}};
    for (const auto& object : objects)
    {
        const auto path = folder + "/entry.rawlog";
        testing::write_plain(path, {object});
        sample.bytes += read_text(path);
        sample.entry_ends.push_back(sample.bytes.size());
    }
    return sample;
}

std::vector<Sample> rawlogs(const std::string& folder)
{
    auto object = rawlog_of("object", one_rawlog_object(), folder);
    object.entry_ends.clear();  // its entries end elsewhere
    return {rawlog_of("mono", observations(mono), folder),
            rawlog_of("stereo", observations(stereo), folder),
            rawlog_of("rgbd", observations(range_scan), folder),
            rawlog_of("frames", actions_and_frames(), folder),
            object};
}

std::vector<Sample> configurations()
{
    std::vector<Sample> samples;
    for (const auto& entry : std::filesystem::directory_iterator(FILD_SOURCE_DIR "/config-ini"))
        if (entry.path().filename() != "graphslam_engine.ini")  // MRPT's engine reads it
            samples.push_back({"", read_text(entry.path().string()), {}});
    return samples;
}

std::vector<Sample> matrices(const std::string& folder)
{
    const testing::Cells loops{{10, 2}, {11, 3}, {19, 5}};
    std::vector<Sample> samples;
    const auto add = [&](auto&& write)
    {
        const auto path = folder + "/made.mat";
        {
            testing::MatFile file(path);
            write(file);
        }
        samples.push_back({"", read_text(path), {}});
    };
    add([&](testing::MatFile& file)
        { file.full<double>("truth", MAT_C_DOUBLE, MAT_T_DOUBLE, 20, 20, loops); });
    add([&](testing::MatFile& file)
        { file.full<std::uint8_t>("truth", MAT_C_UINT8, MAT_T_UINT8, 20, 20, loops); });
    add([&](testing::MatFile& file) { file.sparse("truth", 20, loops, false); });
    add(
        [&](testing::MatFile& file)
        {
            file.text("note", "loops");
            file.sparse("truth", 20, loops, true);
        });
    return samples;
}

std::vector<FrameVerdict> verdicts()
{
    std::vector<FrameVerdict> all(12);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        all[i].frame = FrameId{i};
        all[i].timestamp = static_cast<double>(i);
        all[i].sensor_label = i == 3 ? "C\"A,\nM" : "CAM";
        all[i].rejection = i < 8 ? Rejection::too_early : Rejection::none;
        if (i >= 8) all[i].candidate = Candidate{FrameId{i - 8}, 0.9F};
    }
    return all;
}

std::vector<Sample> tables(const std::string& folder)
{
    const auto path = folder + "/made.csv";
    CsvWriter<FrameRow> frames(path, frames_csv_columns());
    CsvWriter<PoseRow> poses(path + ".poses", poses_csv_columns());
    CsvWriter<CandidateRow> candidates(path + ".candidates", candidates_csv_columns());
    CsvWriter<LoopRow> loops(path + ".loops", loops_csv_columns());
    CsvWriter<CostRow> costs(path + ".costs", costs_csv_columns());
    for (const auto& verdict : verdicts())
    {
        frames.add({verdict, "stereo"});
        poses.add({verdict.frame, {1, 2, 3, 0, 0, 0, 1}, {1, 2, 3, 0, 0, 1, 0}});
        costs.add({verdict.frame, {}, 1000, 2000});
        if (!verdict.candidate) continue;
        ConsideredCandidate considered;
        considered.candidate = *verdict.candidate;
        considered.rank = 1;
        considered.checked = true;
        candidates.add({verdict.frame, considered});
        LoopRow loop;
        loop.verdict = verdict;
        loop.position = loop.angles = {1, 2, 3};
        loops.add(loop);
    }
    frames.commit();
    poses.commit();
    candidates.commit();
    loops.commit();
    costs.commit();
    return {{"frames", read_text(path), {}},
            {"poses", read_text(path + ".poses"), {}},
            {"candidates", read_text(path + ".candidates"), {}},
            {"loops", read_text(path + ".loops"), {}},
            {"costs", read_text(path + ".costs"), {}}};
}

std::vector<Sample> lists()
{
    const std::string tum = "0.5 1 2 3 0 0 0 1\n1.5 2 2 3 0 0 0 1\n2.5 3 2 3 0 0 0.7071 0.7071\n";
    const std::string kitti = "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 2\n";
    return {{"labels", "# query candidate\n10 2\n11 3 1\n12 4 0\n", {}},
            {"tum", tum, {}},
            {"tum_path", tum, {}},
            {"kitti", kitti, {}},
            {"images", "a.png 0.5\nb.png 1.5\n", {}},
            {"calibration", "500 500 320 240 640 480 -0.1 0.01 0 0 0\nbaseline 0.12\n", {}}};
}

std::vector<Sample> images(const std::string& ending, const std::string& folder)
{
    std::vector<Sample> samples;
    for (const int type : {CV_8UC1, CV_8UC3})
    {
        cv::Mat image(48, 64, type);
        cv::randu(image, 0, 255);
        const auto path = folder + "/made." + ending;
        for (const bool is_smooth : {false, true})
        {
            if (is_smooth) image = testing::draw_image(type);
            cv::imwrite(path, image, {cv::IMWRITE_JPEG_PROGRESSIVE, is_smooth ? 1 : 0});
            samples.push_back({"", read_text(path), {}});
        }
    }
    return samples;
}
}  // namespace

std::string packed(const std::string& bytes, const std::string& folder)
{
    const auto path = folder + "/packed.gz";
    {
        mrpt::io::CFileGZOutputStream file(path);
        if (!bytes.empty()) file.Write(bytes.data(), bytes.size());
    }
    return read_text(path);
}

std::vector<Sample> make_corpus(Kind kind, const std::string& folder)
{
    switch (kind)
    {
        case Kind::rawlog:
        case Kind::rawlog_gz:
            return rawlogs(folder);
        case Kind::ini:
            return configurations();
        case Kind::mat:
            return matrices(folder);
        case Kind::csv:
            return tables(folder);
        case Kind::list:
            return lists();
        case Kind::onnx:
            return {{"onednn", read_text(FILD_TINY_NETWORK), {}},
                    {"onednn", read_text(FILD_RESIDUAL_NETWORK), {}},
                    {"opencv", read_text(FILD_TINY_NETWORK), {}}};
        case Kind::jpg:
            return images("jpg", folder);
        case Kind::png:
            return images("png", folder);
    }
    return {};
}

}  // namespace fild::fuzz
