// SPDX-License-Identifier: BSD-3-Clause
// A scene of points seen by two cameras with known poses and noise.
#pragma once

#include "fild/core/random.h"
#include "fild/geometry/relative_pose.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace fild::testing
{
/** Uniform and normal numbers. */
class Dice
{
 public:
    explicit Dice(std::uint64_t seed) : generator_(seed) {}
    double uniform(double low, double high)
    {
        return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1.0p-53;
    }
    double normal(double deviation) { return deviation * standard_normal(generator_); }

 private:
    std::mt19937_64 generator_;
};

inline CameraModel pinhole_camera()
{
    CameraModel camera;
    camera.fx = 400;
    camera.fy = 410;
    camera.cx = 319.5;
    camera.cy = 239.5;
    camera.width = 640;
    camera.height = 480;
    return camera;
}

/** What makes a scene. */
struct SceneRecipe
{
    std::size_t points = 150;
    std::size_t outliers = 0;  ///< matches of unrelated pixels, after the points
    double pixel_noise = 0;
    double inverse_depth_noise = 0;  ///< 1/metres
    double near = 4;  ///< metres
    double far = 15;
    bool planar = false;  ///< all on one slanted wall
    bool query_depth = true;
    bool candidate_depth = true;
};

/** Two frames of a scene and the truth. */
struct Scene
{
    std::optional<CameraModel> camera = pinhole_camera();
    RigidTransform candidate_from_query;
    std::vector<PixelPosition> query;
    std::vector<PixelPosition> candidate;
    KeypointDepths query_depths;
    KeypointDepths candidate_depths;
    std::vector<Match> matches;

    PoseView query_view() const { return {camera, query, query_depths}; }
    PoseView candidate_view() const { return {camera, candidate, candidate_depths}; }
};

/** A pixel and a depth measured with noise. */
inline void add_measurement(const cv::Vec3d& point,
                            const SceneRecipe& recipe,
                            Dice& dice,
                            std::vector<PixelPosition>& positions,
                            KeypointDepths& depths)
{
    const auto camera = pinhole_camera();
    positions.push_back({static_cast<float>(camera.fx * point[0] / point[2] + camera.cx +
                                            dice.normal(recipe.pixel_noise)),
                         static_cast<float>(camera.fy * point[1] / point[2] + camera.cy +
                                            dice.normal(recipe.pixel_noise))});
    const double z = 1 / (1 / point[2] + dice.normal(recipe.inverse_depth_noise));
    depths.metres.push_back(static_cast<float>(z));
    const double declared = std::max(recipe.inverse_depth_noise, 1e-5);
    depths.deviations_m.push_back(static_cast<float>(declared * z * z));
}

inline Scene make_scene(const SceneRecipe& recipe, std::uint64_t seed)
{
    Dice dice(seed);
    Scene scene;
    scene.candidate_from_query.rotation =
        rotation_from_vector({dice.normal(0.03), dice.normal(0.1), dice.normal(0.03)});
    scene.candidate_from_query.translation = {dice.normal(0.5), dice.normal(0.1), dice.normal(0.8)};
    const auto query_from_candidate = scene.candidate_from_query.inverse();
    for (std::size_t i = 0; i < recipe.points; ++i)
    {
        const double x = dice.uniform(-0.6, 0.6);
        const double y = dice.uniform(-0.45, 0.45);
        const double z = recipe.planar ? 8 / (1 - 0.4 * x) : dice.uniform(recipe.near, recipe.far);
        const cv::Vec3d in_candidate(x * z, y * z, z);
        add_measurement(in_candidate, recipe, dice, scene.candidate, scene.candidate_depths);
        add_measurement(
            query_from_candidate * in_candidate, recipe, dice, scene.query, scene.query_depths);
    }
    for (std::size_t i = 0; i < recipe.outliers; ++i)
    {
        const auto anywhere = [&]
        {
            const double z = dice.uniform(recipe.near, recipe.far);
            return cv::Vec3d(z * dice.uniform(-0.7, 0.7), z * dice.uniform(-0.5, 0.5), z);
        };
        add_measurement(anywhere(), recipe, dice, scene.candidate, scene.candidate_depths);
        add_measurement(anywhere(), recipe, dice, scene.query, scene.query_depths);
    }
    for (std::size_t i = 0; i < scene.query.size(); ++i) scene.matches.push_back({i, i, 0});
    if (recipe.query_depth) scene.query_depths.source = DepthSource::stereo;
    if (recipe.candidate_depth) scene.candidate_depths.source = DepthSource::stereo;
    return scene;
}

}  // namespace fild::testing
