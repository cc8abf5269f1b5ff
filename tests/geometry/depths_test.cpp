// SPDX-License-Identifier: BSD-3-Clause
// Depths of keypoints from a depth image, a drawn stereo pair and motion.
#include "fild/geometry/image_depths.h"
#include "fild/geometry/motion_depths.h"
#include "fild/geometry/stereo_depths.h"
#include "message_of.h"
#include "pose_scene.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>

namespace
{
using namespace fild::testing;
using fild::DepthSource;
using fild::Frame;
using fild::HashedFeatures;
using fild::KeypointDepths;
using fild::PixelPosition;
using fild::RigidTransform;
using fild::TDepthOptions;

const float kNan = std::numeric_limits<float>::quiet_NaN();

Frame frame_with_depth(const cv::Mat& depth)
{
    Frame frame;
    frame.camera = pinhole_camera();
    frame.depth = depth;
    return frame;
}

TEST(ImageDepths, AreExactOnASlantedPlane)
{
    cv::Mat depth(48, 64, CV_32FC1);
    const auto plane = [](double x, double y) { return 1 / (0.2 + 0.001 * x - 0.0005 * y); };
    for (int row = 0; row < depth.rows; ++row)
        for (int column = 0; column < depth.cols; ++column)
            depth.at<float>(row, column) = static_cast<float>(plane(column, row));
    const std::vector<PixelPosition> pixels{{10.25F, 20.5F}, {3, 3}, {60, 44}, {30, 30.75F}};
    const auto depths = depths_from_image(frame_with_depth(depth), pixels, TDepthOptions());
    EXPECT_EQ(depths.source, DepthSource::depth_image);
    EXPECT_EQ(depths.known(), pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
        EXPECT_NEAR(static_cast<double>(depths.metres[i]),
                    plane(static_cast<double>(pixels[i].x), static_cast<double>(pixels[i].y)),
                    1e-4);
    EXPECT_GT(depths.deviations_m[0], 0);
}

TEST(ImageDepths, AreUnknownAtEdgesAndHoles)
{
    cv::Mat depth(48, 64, CV_32FC1, cv::Scalar(3));
    depth.colRange(32, 64).setTo(4);
    depth.at<float>(10, 10) = kNan;
    depth.at<float>(10, 20) = 0;
    depth.at<float>(30, 10) = -1;
    depth.at<float>(30, 20) = std::numeric_limits<float>::infinity();
    const std::vector<PixelPosition> pixels{{31.5F, 5},
                                            {10.5F, 10.5F},
                                            {19.5F, 9.5F},
                                            {10, 30},
                                            {20, 30},
                                            {-1, 5},
                                            {64, 5},
                                            {5, 47.5F},
                                            {kNan, 5},
                                            {28.4F, 5},
                                            {35.25F, 5}};
    const auto depths = depths_from_image(frame_with_depth(depth), pixels, TDepthOptions());
    EXPECT_EQ(depths.known(), 2U);
    ASSERT_EQ(pixels.size(), 11U);
    EXPECT_FLOAT_EQ(depths.metres[9], 3);
    EXPECT_FLOAT_EQ(depths.metres[10], 4);
    EXPECT_TRUE(std::isnan(depths.deviations_m[0]));
}

TEST(ImageDepths, RefuseAFrameWithoutThem)
{
    EXPECT_THROW(depths_from_image(frame_with_depth({}), {}, TDepthOptions()),
                 std::invalid_argument);
    EXPECT_THROW(depths_from_image(
                     frame_with_depth(cv::Mat(4, 4, CV_16UC1, cv::Scalar(1))), {}, TDepthOptions()),
                 std::invalid_argument);
}

/** A pair that looks at a slanted plane with a random smooth texture. */
class DrawnPair
{
 public:
    explicit DrawnPair(const RigidTransform& left_from_right)
    {
        cv::Mat noise(1500, 2000, CV_8UC1);
        cv::RNG rng(7);
        rng.fill(noise, cv::RNG::UNIFORM, 0, 256);
        cv::GaussianBlur(noise, texture_, {}, 3);
        cv::normalize(texture_, texture_, 0, 255, cv::NORM_MINMAX);
        frame_.camera = pinhole_camera();
        frame_.image = draw({});
        frame_.right = fild::RightView{draw(left_from_right), pinhole_camera(), left_from_right};
    }

    /** Depth in the left camera at a pixel: the plane z = 6 + 0.3 x. */
    static double true_depth(double x, double y)
    {
        const auto camera = pinhole_camera();
        const cv::Vec3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
        return 6 / (1 - 0.3 * ray[0]);
    }

    Frame& frame() { return frame_; }

    /** Keypoints on a grid, with a code of their own each, as both cameras see them: the right ones
     *  up to a pixel off. */
    std::pair<HashedFeatures, HashedFeatures> features() const
    {
        std::pair<HashedFeatures, HashedFeatures> both;
        std::mt19937_64 generator(3);
        for (auto* side : {&both.first, &both.second})
        {
            side->codes.bits = 256;
            side->codes.words_per_code = 4;
        }
        const auto right_from_left = frame_.right->left_from_right.inverse();
        const auto camera = pinhole_camera();
        Dice dice(4);
        for (int y = 40; y < 440; y += 25)
            for (int x = 100; x < 560; x += 23)
            {
                const double z = true_depth(x, y);
                const cv::Vec3d point(
                    (x - camera.cx) / camera.fx * z, (y - camera.cy) / camera.fy * z, z);
                const auto seen = right_from_left * point;
                both.first.positions.push_back({static_cast<float>(x), static_cast<float>(y)});
                both.second.positions.push_back(
                    {static_cast<float>(camera.fx * seen[0] / seen[2] + camera.cx +
                                        dice.uniform(-0.8, 0.8)),
                     static_cast<float>(camera.fy * seen[1] / seen[2] + camera.cy +
                                        dice.uniform(-0.8, 0.8))});
                for (int w = 0; w < 4; ++w)
                {
                    const auto word = generator();
                    both.first.codes.words.push_back(word);
                    both.second.codes.words.push_back(word ^ (1ULL << (generator() % 64)));
                }
            }
        return both;
    }

 private:
    cv::Mat draw(const RigidTransform& left_from_camera) const
    {
        const auto camera = pinhole_camera();
        cv::Mat map(camera.height, camera.width, CV_32FC2);
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x)
            {
                const cv::Vec3d direction =
                    left_from_camera.rotation *
                    cv::Vec3d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
                const auto& origin = left_from_camera.translation;
                // origin + s * direction on z = 6 + 0.3 x.
                const double s =
                    (6 + 0.3 * origin[0] - origin[2]) / (direction[2] - 0.3 * direction[0]);
                const cv::Vec3d point = origin + s * direction;
                map.at<cv::Vec2f>(y, x) = {static_cast<float>(1000 + 80 * point[0]),
                                           static_cast<float>(750 + 80 * point[1])};
            }
        cv::Mat image;
        cv::remap(texture_, image, map, cv::noArray(), cv::INTER_CUBIC);
        return image;
    }

    cv::Mat texture_;
    Frame frame_;
};

/** Median of the relative errors, and the share of keypoints that have a depth. */
struct Accuracy
{
    double median_error = 1;
    double median_normalised = 0;  ///< error by its standard deviation
    double known_share = 0;
};

Accuracy accuracy_of(const KeypointDepths& depths, const std::vector<PixelPosition>& pixels)
{
    std::vector<double> errors;
    std::vector<double> normalised;
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        if (!(depths.metres[i] > 0)) continue;
        const double truth = DrawnPair::true_depth(static_cast<double>(pixels[i].x),
                                                   static_cast<double>(pixels[i].y));
        const double error = std::abs(static_cast<double>(depths.metres[i]) - truth);
        errors.push_back(error / truth);
        normalised.push_back(error / static_cast<double>(depths.deviations_m[i]));
    }
    if (errors.empty()) return {};
    const auto middle = static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), errors.begin() + middle, errors.end());
    std::nth_element(normalised.begin(), normalised.begin() + middle, normalised.end());
    return {errors[errors.size() / 2],
            normalised[normalised.size() / 2],
            static_cast<double>(errors.size()) / static_cast<double>(pixels.size())};
}

Accuracy stereo_accuracy(const RigidTransform& left_from_right)
{
    DrawnPair pair(left_from_right);
    const auto [left, right] = pair.features();
    const auto depths = depths_from_stereo(pair.frame(), left, right, TDepthOptions());
    EXPECT_EQ(depths.source, DepthSource::stereo);
    return accuracy_of(depths, left.positions);
}

void expect_good(const Accuracy& accuracy)
{
    EXPECT_LT(accuracy.median_error, 0.002);  // some 0.05 pixels of 20 to 30
    EXPECT_LT(accuracy.median_normalised, 1);
    EXPECT_GT(accuracy.known_share, 0.85);
}

TEST(StereoDepths, AreExactForARectifiedPair)
{
    expect_good(stereo_accuracy({cv::Matx33d::eye(), {0.4, 0, 0}}));
}

TEST(StereoDepths, AreExactForCamerasThatSquint)
{
    expect_good(
        stereo_accuracy({fild::rotation_from_vector({0.02, -0.05, 0.03}), {0.4, 0.02, -0.03}}));
}

TEST(StereoDepths, AreExactForOneCameraAboveTheOther)
{
    expect_good(stereo_accuracy({cv::Matx33d::eye(), {0, 0.4, 0}}));
}

/** Drawn as the right camera stood 20 ms later, on a robot that drives and turns. */
Accuracy accuracy_of_moved_pair(double seconds_later)
{
    const RigidTransform calibrated{cv::Matx33d::eye(), {0.4, 0, 0}};
    const RigidTransform motion{fild::rotation_from_vector({0.002, -0.001, 0.003}), {0, 0, 0.12}};
    DrawnPair pair(motion * calibrated);
    const auto [left, right] = pair.features();
    pair.frame().right->left_from_right = calibrated;
    pair.frame().right->seconds_later = seconds_later;
    return accuracy_of(depths_from_stereo(pair.frame(), left, right, TDepthOptions()),
                       left.positions);
}

TEST(StereoDepths, FollowARobotThatMovesBetweenTheTwoImages)
{
    EXPECT_GT(accuracy_of_moved_pair(0).median_error, 0.05) << "as if of one moment";
    const auto accuracy = accuracy_of_moved_pair(0.02);
    EXPECT_LT(accuracy.median_error, 0.009) << "one plane, which tells little of a turn";
    EXPECT_GT(accuracy.known_share, 0.8);
}

TEST(StereoDepths, AreAsGoodWhereTheTimeStampsDifferAndTheImagesDoNot)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    const auto [left, right] = pair.features();
    pair.frame().right->seconds_later = 0.004;
    const auto accuracy =
        accuracy_of(depths_from_stereo(pair.frame(), left, right, TDepthOptions()), left.positions);
    EXPECT_LT(accuracy.median_error, 0.004);
    EXPECT_GT(accuracy.known_share, 0.85);
}

TEST(StereoDepths, OfABlankWallAreUnknown)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    const auto [left, right] = pair.features();
    pair.frame().image.setTo(90);
    pair.frame().right->image.setTo(90);
    EXPECT_EQ(depths_from_stereo(pair.frame(), left, right, TDepthOptions()).known(), 0U);
}

TEST(StereoDepths, OfUnrelatedImagesAreUnknown)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    const auto [left, right] = pair.features();
    cv::flip(pair.frame().right->image, pair.frame().right->image, 0);
    const auto depths = depths_from_stereo(pair.frame(), left, right, TDepthOptions());
    EXPECT_LT(depths.known(), left.positions.size() / 20);
}

TEST(StereoDepths, NeedAUsableBaseline)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    const auto [left, right] = pair.features();
    for (const double baseline : {0.0, -0.4})
    {
        pair.frame().right->left_from_right.translation = {baseline, 0, 0};
        const auto depths = depths_from_stereo(pair.frame(), left, right, TDepthOptions());
        EXPECT_EQ(depths.source, DepthSource::none);
        EXPECT_EQ(depths.known(), 0U);
    }
}

TEST(StereoDepths, OfNoKeypointsAreNone)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    EXPECT_EQ(depths_from_stereo(pair.frame(), {}, {}, TDepthOptions()).metres.size(), 0U);
}

TEST(StereoDepths, RefuseWhatIsNoPair)
{
    DrawnPair pair({cv::Matx33d::eye(), {0.4, 0, 0}});
    const auto [left, right] = pair.features();
    auto other_codes = right;
    other_codes.codes.bits = 128;
    EXPECT_THROW(depths_from_stereo(pair.frame(), left, other_codes, TDepthOptions()),
                 std::invalid_argument);
    pair.frame().right->camera.width = 100;
    EXPECT_THROW(depths_from_stereo(pair.frame(), left, right, TDepthOptions()),
                 std::invalid_argument);
    pair.frame().right.reset();
    EXPECT_THROW(depths_from_stereo(pair.frame(), left, right, TDepthOptions()),
                 std::invalid_argument);
}

/** Two frames of a scene as a moving camera takes them; the candidate stands for the earlier one.
 */
fild::MovedView moved_view(const Scene& scene)
{
    return {*scene.camera,
            scene.query,
            scene.candidate,
            scene.matches,
            scene.candidate_from_query,
            0.02};
}

Scene moving_scene(double pixel_noise)
{
    SceneRecipe recipe;
    recipe.points = 200;
    recipe.outliers = 20;
    recipe.pixel_noise = pixel_noise;
    return make_scene(recipe, 21);
}

TEST(MotionDepths, AreExactOfExactPixels)
{
    const auto scene = moving_scene(0);
    const auto depths = depths_from_motion(moved_view(scene), TDepthOptions(), 1);
    EXPECT_EQ(depths.source, DepthSource::motion);
    EXPECT_EQ(depths.scale_deviation, 0.02);
    EXPECT_GT(depths.known(), 100U);
    for (std::size_t i = 0; i < 200; ++i)
    {
        if (!(depths.metres[i] > 0)) continue;
        EXPECT_NEAR(static_cast<double>(depths.metres[i] / scene.query_depths.metres[i]), 1, 5e-3);
    }
}

TEST(MotionDepths, AreAsExactAsTheySay)
{
    const auto scene = moving_scene(0.5);
    TDepthOptions options;
    options.pixel_deviation_px = 0.5;
    const auto depths = depths_from_motion(moved_view(scene), options, 1);
    std::vector<double> normalised;
    for (std::size_t i = 0; i < 200; ++i)
        if (depths.metres[i] > 0)
            normalised.push_back(
                static_cast<double>(std::abs(depths.metres[i] - scene.query_depths.metres[i]) /
                                    depths.deviations_m[i]));
    ASSERT_GT(normalised.size(), 80U);
    const auto within_two =
        std::count_if(normalised.begin(), normalised.end(), [](double error) { return error < 2; });
    EXPECT_GT(static_cast<double>(within_two), 0.85 * static_cast<double>(normalised.size()));
}

TEST(MotionDepths, TakeTheLengthOnlyFromTheOdometry)
{
    const auto scene = moving_scene(0);
    auto view = moved_view(scene);
    view.earlier_from_current.translation *= 1.1;
    view.earlier_from_current.rotation =
        view.earlier_from_current.rotation * fild::rotation_from_vector({0.05, 0, 0.02});
    const auto depths = depths_from_motion(view, TDepthOptions(), 1);
    EXPECT_GT(depths.known(), 100U);
    for (std::size_t i = 0; i < 200; ++i)
    {
        if (!(depths.metres[i] > 0)) continue;
        EXPECT_NEAR(
            static_cast<double>(depths.metres[i] / scene.query_depths.metres[i]), 1.1, 1e-2);
    }
}

TEST(MotionDepths, AreNoneWithoutABaselineOrWhereOdometryAndImagesDisagree)
{
    const auto scene = moving_scene(0.3);
    auto view = moved_view(scene);
    view.earlier_from_current.translation = {};
    EXPECT_EQ(depths_from_motion(view, TDepthOptions(), 1).source, DepthSource::none);
    view.earlier_from_current.translation[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(depths_from_motion(view, TDepthOptions(), 1).source, DepthSource::none);
    view.earlier_from_current.translation = -scene.candidate_from_query.translation;
    EXPECT_EQ(depths_from_motion(view, TDepthOptions(), 1).source, DepthSource::none);
    const std::vector<fild::Match> few(scene.matches.begin(), scene.matches.begin() + 5);
    EXPECT_EQ(depths_from_motion(
                  {view.camera, view.current, view.earlier, few, view.earlier_from_current, 0},
                  TDepthOptions(),
                  1)
                  .source,
              DepthSource::none);
}

TEST(MotionDepths, RefuseMatchesOfNoKeypoint)
{
    auto scene = moving_scene(0);
    scene.matches.push_back({0, scene.candidate.size(), 0});
    EXPECT_THROW(depths_from_motion(moved_view(scene), TDepthOptions(), 1), std::invalid_argument);
}

TEST(DepthSource, HasAWordForEach)
{
    EXPECT_EQ(to_word(DepthSource::none), "none");
    EXPECT_EQ(to_word(DepthSource::stereo), "stereo");
    EXPECT_EQ(to_word(DepthSource::depth_image), "depth_image");
    EXPECT_EQ(to_word(DepthSource::motion), "motion");
}

}  // namespace
