// SPDX-License-Identifier: BSD-3-Clause
// Metric poses of one camera: depth from motion with the odometry's baseline, on real images.
#include "fild/geometry/motion_depths.h"
#include "loop_edges.h"

#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cstdio>
#include <filesystem>

namespace
{
using namespace fild::testing;
using fild::RigidTransform;
namespace fs = std::filesystem;

const fs::path kSequence = fs::path(FILD_TEST_DATA_DIR) / "kitti03";

/** world_from_camera of each frame: the first three rows of a matrix a line. */
std::vector<RigidTransform> read_kitti(const fs::path& path)
{
    std::vector<RigidTransform> poses;
    std::ifstream file(path);
    for (std::array<double, 12> m{}; file;)
    {
        for (auto& number : m) file >> number;
        if (!file) break;
        poses.push_back(
            {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, {m[3], m[7], m[11]}});
    }
    return poses;
}

/** Frames of the sequence as a moving camera sees them. */
class Drive
{
 public:
    Drive() : poses_(read_kitti(kSequence / "poses_kitti.txt"))
    {
        std::ifstream file(kSequence / "calib.txt");
        std::string line;
        while (std::getline(file, line) && line[0] == '#') continue;
        camera_ = fild::parse_camera_model(line, "calib.txt");
    }

    std::size_t size() const { return poses_.size(); }

    RigidTransform truth(std::size_t to, std::size_t from) const
    {
        return poses_.at(to).inverse() * poses_.at(from);
    }

    fild::HashedFeatures features(std::size_t frame) const
    {
        std::array<char, 16> name{};
        std::snprintf(name.data(), name.size(), "%06zu.jpg", frame);
        return describer_.describe(
            cv::imread((kSequence / "images" / name.data()).string(), cv::IMREAD_GRAYSCALE));
    }

    /** A frame with the depths that an earlier one gives it; the truth stands for odometry. */
    KeptFrame with_depths(std::size_t frame, std::size_t earlier) const
    {
        KeptFrame kept{camera_, {}, features(frame), {}};
        const auto before = features(earlier);
        kept.depths = depths_from_motion({camera_,
                                          kept.local.positions,
                                          before.positions,
                                          verified_matches(kept.local, before),
                                          truth(earlier, frame),
                                          0.01},
                                         fild::TDepthOptions(),
                                         1);
        return kept;
    }

 private:
    std::vector<RigidTransform> poses_;
    fild::CameraModel camera_;
    Describer describer_;
};

TEST(MonoScale, IsThatOfTheOdometry)
{
    for (const auto* name : {"poses_kitti.txt", "calib.txt", "images"})
        if (!fs::exists(kSequence / name)) GTEST_SKIP() << kSequence / name << " is missing";
    const Drive drive;
    const fild::RelativePoseEstimator estimator(fild::TRelativePoseOptions(), 1);
    constexpr std::size_t kBaselineFrames = 3;  // some 2.3 m
    constexpr std::size_t kQueryFrames = 2;
    std::vector<double> scale_errors;
    std::size_t known = 0;
    std::size_t tried = 0;
    for (std::size_t frame = 10; frame + kQueryFrames < drive.size(); frame += 40, ++tried)
    {
        const auto candidate = drive.with_depths(frame, frame - kBaselineFrames);
        known += candidate.depths.known();
        const auto query = drive.features(frame + kQueryFrames);
        const fild::KeypointDepths no_depths;
        const auto pose =
            estimator.estimate({candidate.camera, query.positions, no_depths},
                               {candidate.camera, candidate.local.positions, candidate.depths},
                               verified_matches(query, candidate.local));
        if (!pose.candidate_from_query) continue;
        const auto truth = drive.truth(frame, frame + kQueryFrames);
        const double length = cv::norm(pose.candidate_from_query->b_from_a.translation);
        scale_errors.push_back(std::abs(length / cv::norm(truth.translation) - 1));
    }
    ASSERT_GT(tried, 0U) << "too few poses in " << kSequence / "poses_kitti.txt";
    const double median = EdgeStatistics::median_of(scale_errors);
    std::cout << scale_errors.size() << " poses of " << tried << " frames with " << known / tried
              << " depths each; median scale error " << 100 * median << " %\n";
    EXPECT_GE(scale_errors.size(), tried * 3 / 4);
    EXPECT_LT(median, 0.05);
}

}  // namespace
