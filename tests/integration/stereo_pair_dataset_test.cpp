// SPDX-License-Identifier: BSD-3-Clause
// Two real cameras with distortion, recorded one by one, made to stereo pairs and rectified: depths
// against the depths of the pair as it is undistorted only, and loop edges against Vicon.
#include "fild/rawlog/camera_conversion.h"
#include "loop_edges.h"

#include <mrpt/obs/CObservationImage.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <filesystem>

namespace
{
using namespace fild::testing;
using fild::CameraModel;
using fild::Frame;
using fild::RigidTransform;
using mrpt::obs::CObservationImage;
namespace fs = std::filesystem;

const fs::path kFlight = fs::path(FILD_TEST_DATA_DIR) / "euroc_v101";

/** A camera of the head, and where it is on the flying robot. */
struct HeadCamera
{
    CameraModel camera;
    RigidTransform body_from_camera;
};

/** \param side  "left" or "right". */
HeadCamera read_head_camera(const std::string& side)
{
    HeadCamera head;
    std::ifstream file(kFlight / "calib_raw.txt");
    for (std::string line; std::getline(file, line);)
    {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == side)
        {
            std::string numbers;
            std::getline(words, numbers);
            head.camera = fild::parse_camera_model(numbers, "calib_raw.txt");
        }
        if (word != "T_body_" + side) continue;
        std::array<double, 16> m{};
        for (auto& number : m) words >> number;
        head.body_from_camera = {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]},
                                 {m[3], m[7], m[11]}};
    }
    return head;
}

struct FlightFrame
{
    double seconds = 0;
    fs::path left;
    fs::path right;
    RigidTransform world_from_left;
};

std::vector<FlightFrame> read_flight()
{
    std::vector<FlightFrame> frames;
    for (const auto& entry : fs::directory_iterator(kFlight / "left"))
    {
        const auto name = entry.path().stem().string();  // NANOSECONDS_0
        const auto nanoseconds = name.substr(0, name.size() - 2);
        frames.push_back({std::stod(nanoseconds) / 1e9,
                          entry.path(),
                          kFlight / "right" / (nanoseconds + "_1.jpg"),
                          {}});
    }
    std::sort(frames.begin(),
              frames.end(),
              [](const FlightFrame& a, const FlightFrame& b) { return a.seconds < b.seconds; });
    const auto truth = read_tum((kFlight / "poses_cam0.tum").string());
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].world_from_left = truth.at(i);
    return frames;
}

CObservationImage::Ptr observation_of(const fs::path& path,
                                      const std::string& label,
                                      double seconds,
                                      const HeadCamera& head)
{
    auto observation = CObservationImage::Create();
    observation->sensorLabel = label;
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->image =
        mrpt::img::CImage(cv::imread(path.string(), cv::IMREAD_GRAYSCALE), mrpt::img::SHALLOW_COPY);
    observation->cameraParams = mrpt_camera_from(head.camera);
    observation->cameraPose = mrpt_pose_from(head.body_from_camera);
    return observation;
}

/** The flight's frames as two cameras record them that are triggered together. */
std::vector<Frame> paired_frames(const std::vector<FlightFrame>& flight)
{
    const auto left = read_head_camera("left");
    const auto right = read_head_camera("right");
    fild::StereoPairing pairing{fild::TInputOptions()};
    fild::FrameBuilder builder({}, "flight.rawlog", fild::FrameContent::metric);
    std::vector<Frame> frames;
    const auto take = [&](const fild::StereoPairing::Observations& observations)
    {
        for (const auto& observation : observations)
            if (builder.accepts(*observation)) frames.push_back(builder.build(*observation));
    };
    for (const auto& each : flight)
    {
        take(pairing.feed(*observation_of(each.left, "LEFT", each.seconds, left)));
        take(pairing.feed(*observation_of(each.right, "RIGHT", each.seconds, right)));
    }
    take(pairing.finish());
    EXPECT_EQ(pairing.report()->paired, flight.size());
    return frames;
}

cv::Mat undistorted(const fs::path& path, const CameraModel& camera)
{
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    cv::Mat image;
    cv::undistort(cv::imread(path.string(), cv::IMREAD_GRAYSCALE),
                  image,
                  k,
                  std::vector<double>(camera.distortion.begin(), camera.distortion.end()));
    return image;
}

CameraModel as_pinhole(CameraModel camera)
{
    camera.lens = fild::LensModel::none;
    camera.distortion.fill(0);
    return camera;
}

/** The pair undistorted and not rectified: the depths are then rectified by themselves. */
Frame undistorted_frame(const FlightFrame& flight)
{
    const auto left = read_head_camera("left");
    const auto right = read_head_camera("right");
    Frame frame;
    frame.image = undistorted(flight.left, left.camera);
    frame.camera = as_pinhole(left.camera);
    frame.robot_from_camera = left.body_from_camera;
    frame.right = fild::RightView{undistorted(flight.right, right.camera),
                                  as_pinhole(right.camera),
                                  left.body_from_camera.inverse() * right.body_from_camera};
    return frame;
}

double share_known(const KeptFrame& frame)
{
    return static_cast<double>(frame.depths.known()) /
           static_cast<double>(frame.local.positions.size());
}

/** Of each frame the earlier ones within 1 m and 30 degrees, at least ten frames before. */
std::vector<FramePair> revisits(const std::vector<FlightFrame>& flight)
{
    std::vector<FramePair> pairs;
    for (std::size_t query = 0; query < flight.size(); ++query)
        for (std::size_t candidate = 0; candidate + 10 <= query; ++candidate)
        {
            const auto motion =
                flight[candidate].world_from_left.inverse() * flight[query].world_from_left;
            if (cv::norm(motion.translation) < 1 &&
                cv::norm(fild::vector_from_rotation(motion.rotation)) <
                    30 * fild::kRadiansPerDegree)
                pairs.push_back({query, candidate});
        }
    return pairs;
}

std::vector<KeptFrame> described(const std::vector<Frame>& frames)
{
    const Describer describer;
    std::vector<KeptFrame> kept_frames;
    for (const auto& frame : frames) kept_frames.push_back(kept(frame, describer));
    return kept_frames;
}

/** Median over the pixels of keypoints of both: depths of one against those of the other. */
double median_disagreement(const KeptFrame& rectified, const KeptFrame& plain)
{
    const auto plain_from_rectified =
        plain.robot_from_camera.inverse() * rectified.robot_from_camera;
    std::vector<double> relative;
    for (std::size_t i = 0; i < rectified.local.positions.size(); ++i)
    {
        const double z = static_cast<double>(rectified.depths.metres[i]);
        if (!(z > 0)) continue;
        const auto& pixel = rectified.local.positions[i];
        const auto& camera = *rectified.camera;
        const auto point = plain_from_rectified *
                           cv::Vec3d((static_cast<double>(pixel.x) - camera.cx) / camera.fx * z,
                                     (static_cast<double>(pixel.y) - camera.cy) / camera.fy * z,
                                     z);
        const double x = plain.camera->fx * point[0] / point[2] + plain.camera->cx;
        const double y = plain.camera->fy * point[1] / point[2] + plain.camera->cy;
        for (std::size_t k = 0; k < plain.local.positions.size(); ++k)
        {
            const auto& other = plain.local.positions[k];
            const double other_z = static_cast<double>(plain.depths.metres[k]);
            if (other_z > 0 &&
                std::hypot(static_cast<double>(other.x) - x, static_cast<double>(other.y) - y) < 1)
                relative.push_back(std::abs(point[2] - other_z) / other_z);
        }
    }
    return EdgeStatistics::median_of(relative);
}

TEST(EurocPairs, HaveTheDepthsOfTheUndistortedPair)
{
    if (!fs::exists(kFlight)) GTEST_SKIP() << "missing: " << kFlight;
    auto flight = read_flight();
    flight.resize(10);
    const auto frames = described(paired_frames(flight));
    const Describer describer;
    ASSERT_EQ(frames.size(), flight.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        const auto plain = kept(undistorted_frame(flight[i]), describer);
        EXPECT_GT(share_known(frames[i]), 0.9 * share_known(plain)) << i;
        EXPECT_LT(median_disagreement(frames[i], plain), 0.01) << i;
    }
}

TEST(EurocPairs, GiveLoopEdgesToTwoCentimetres)
{
    if (!fs::exists(kFlight)) GTEST_SKIP() << "missing: " << kFlight;
    const auto flight = read_flight();
    const auto frames = described(paired_frames(flight));
    ASSERT_EQ(frames.size(), flight.size());
    const auto left = read_head_camera("left");
    std::vector<RigidTransform> world_from_body;
    for (const auto& each : flight)
        world_from_body.push_back(each.world_from_left * left.body_from_camera.inverse());
    double share = 0;
    for (const auto& frame : frames)
        share += share_known(frame) / static_cast<double>(frames.size());
    const auto edges = edge_statistics(frames, world_from_body, revisits(flight));
    const auto text = edges.text() + "; keypoints with depth " + std::to_string(100 * share) + " %";
    EXPECT_GT(share, 0.4) << text;
    EXPECT_GT(edges.errors.size(), 40U) << text;
    EXPECT_LT(edges.median(&EdgeError::metres), 0.02) << text;
    EXPECT_LT(edges.median(&EdgeError::degrees), 0.33) << text;
}

}  // namespace
