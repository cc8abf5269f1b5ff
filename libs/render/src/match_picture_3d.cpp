// SPDX-License-Identifier: BSD-3-Clause
#include "colour_scale.h"
#include "fild/render/match_picture.h"
#include "fild/render/offscreen_renderer.h"
#include "framing.h"
#include "match_caption.h"
#include "picture_text.h"
#include "scene_objects.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace fild
{
namespace
{
using Corners = std::array<cv::Vec3d, 4>;

const cv::Scalar kQueryColour(178, 114, 0);
const cv::Scalar kCandidateColour(0, 94, 213);

/** An image and its camera, in a frame with z up. */
struct StandingImage
{
    CameraModel camera;
    RigidTransform world_from_camera;
    double distance = 1;  ///< of the image plane, metres

    Corners corners() const { return image_corners(camera, world_from_camera, distance); }

    cv::Vec3d place_of(const PixelPosition& pixel) const
    {
        const cv::Point2d at(static_cast<double>(pixel.x), static_cast<double>(pixel.y));
        return world_from_camera * point_at(camera, at, distance);
    }
};

struct StandingPair
{
    StandingImage query;
    StandingImage candidate;
};

void check_cameras(const CameraPair& cameras)
{
    for (const auto* camera : {&cameras.query, &cameras.candidate})
        if (camera->lens != LensModel::none || camera->width < 1 || camera->height < 1 ||
            !(camera->fx > 0) || !(camera->fy > 0))
            throw std::invalid_argument("a match picture in 3D needs pinhole cameras of a size");
    const auto& pose = cameras.candidate_from_query;
    if (!std::isfinite(cv::norm(pose.translation)) || !std::isfinite(cv::norm(pose.rotation)))
        throw std::invalid_argument("a match picture in 3D whose pose is not finite");
}

/** Both cameras, the candidate's level; the images as far before them that they stand apart. */
StandingPair stand_up(const CameraPair& cameras)
{
    const double apart = cv::norm(cameras.candidate_from_query.translation);
    constexpr double kTogether = 0.01;  // metres
    const double distance = 0.6 * std::max(apart, kTogether);
    RigidTransform world_from_candidate;
    world_from_candidate.rotation = {1, 0, 0, 0, 0, 1, 0, -1, 0};
    return {{cameras.query, world_from_candidate * cameras.candidate_from_query, distance},
            {cameras.candidate, world_from_candidate, distance}};
}

std::vector<cv::Vec3d> points_of(const StandingPair& pair)
{
    std::vector<cv::Vec3d> points;
    for (const auto* image : {&pair.query, &pair.candidate})
    {
        const auto corners = image->corners();
        points.insert(points.end(), corners.begin(), corners.end());
        points.push_back(image->world_from_camera.translation);
    }
    return points;
}

std::vector<cv::Point2f> outline(const PictureView& view, const StandingImage& image)
{
    std::vector<cv::Point2f> corners;
    for (const auto& corner : image.corners()) corners.emplace_back(view.project(corner));
    return corners;
}

/** How much of the images a view shows, pixels; nothing of one that it sees from its back. */
double visible_area(const PictureView& view, const StandingPair& pair)
{
    const auto query = outline(view, pair.query);
    const auto candidate = outline(view, pair.candidate);
    const double query_area = cv::contourArea(query, true);
    const double candidate_area = cv::contourArea(candidate, true);
    if (query_area <= 0 || candidate_area <= 0) return std::min(query_area, candidate_area);
    std::vector<cv::Point2f> both;
    const double hidden = cv::intersectConvexConvex(query, candidate, both);
    return std::min(query_area, candidate_area) + 0.5 * std::max(query_area, candidate_area) -
           2 * static_cast<double>(hidden);
}

PictureView best_view(const StandingPair& pair, const cv::Size& size, double margin)
{
    Framing framing;
    framing.points = points_of(pair);
    framing.size = size;
    framing.inside = {margin, 2 * margin, size.width - 2 * margin, size.height - 3 * margin};
    framing.focal_px = 1.4 * size.width;
    framing.nearest_m = pair.query.distance;
    PictureView best;
    double most = -std::numeric_limits<double>::infinity();
    for (const double pitch : {0.15, 0.45, 0.75})
        for (int aside = -4; aside <= 4; ++aside)
        {
            framing.map_from_camera = looking_down(CV_PI / 2 + 0.27 * aside, pitch);
            const auto view = framed_view(framing);
            const double area = visible_area(view, pair);
            if (area <= most) continue;
            most = area;
            best = view;
        }
    return best;
}

mrpt::opengl::COpenGLScene::Ptr make_scene(const MatchPicture& picture,
                                           const StandingPair& pair,
                                           const std::vector<std::size_t>& chosen)
{
    auto scene = empty_scene();
    const double thin = 0.003 * pair.query.distance;
    Strokes lines(Strokes::Shape::round);
    for (const auto i : chosen)
    {
        const auto& inlier = picture.inliers[i];
        const double share = static_cast<double>(inlier.query.y) / pair.query.camera.height;
        lines.add_line(pair.query.place_of(inlier.query),
                       pair.candidate.place_of(inlier.candidate),
                       thin,
                       colour_on_scale(share));
    }
    scene->insert(lines.make("matches"));
    const auto add =
        [&](const StandingImage& image, const cv::Mat& pixels, const cv::Scalar& colour)
    {
        Strokes frustum(Strokes::Shape::round);
        const auto corners = image.corners();
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
            const auto& apex = image.world_from_camera.translation;
            frustum.add_line(apex, corners[k], 1.5 * thin, colour);
            frustum.add_line(corners[k], corners[(k + 1) % corners.size()], 4 * thin, colour);
        }
        scene->insert(frustum.make("camera"));
        ImageWall wall;
        wall.add(pixels, corners);
        constexpr int kWidestImage = 1600;
        scene->insert(wall.make(kWidestImage, "image"));
    };
    add(pair.query, picture.query_image, kQueryColour);
    add(pair.candidate, picture.candidate_image, kCandidateColour);
    return scene;
}

/** Names an image above its upper edge. */
void name_image(cv::Mat& picture,
                const PictureView& view,
                const StandingImage& image,
                const std::string& name,
                const TextStyle& style)
{
    const auto corners = outline(view, image);
    const cv::Point2d middle = (corners[0] + corners[1]) / 2;
    const double half = text_size(name, style).width / 2.0 + style.height_px;
    const double x = std::clamp(middle.x, half, std::max(half, picture.cols - half));
    draw_text(picture, name, {x, middle.y - 0.8 * style.height_px}, style);
}

std::string motion_text(const RigidTransform& candidate_from_query)
{
    std::array<char, 100> text{};
    std::snprintf(text.data(),
                  text.size(),
                  "cameras %.2f m and %.1f deg apart",
                  cv::norm(candidate_from_query.translation),
                  cv::norm(vector_from_rotation(candidate_from_query.rotation)) * 180 / CV_PI);
    return text.data();
}
}  // namespace

cv::Mat draw_match_picture_3d(const MatchPicture& picture,
                              const CameraPair& cameras,
                              const TRenderOptions& options)
{
    check_match_picture(picture);
    check_cameras(cameras);
    const int width = options.match_picture_width_px;
    const double letters = caption_height(width);
    const auto pair = stand_up(cameras);
    const auto view = best_view(pair, {width, cvRound(0.6 * width)}, 2.5 * letters);
    const auto chosen =
        spread_pairs(picture.inliers, static_cast<std::size_t>(options.max_match_lines));
    const double far = cv::norm(view.map_from_camera.translation) + 10 * pair.query.distance;
    OffscreenRenderer renderer(make_scene(picture, pair, chosen),
                               {0.05 * pair.query.distance, far});
    auto drawn = renderer.draw_image(view.camera, to_mrpt(view.map_from_camera));
    name_image(drawn,
               view,
               pair.query,
               query_title(picture).front(),
               {letters, kQueryColour, {0.5, 1}, true});
    name_image(drawn,
               view,
               pair.candidate,
               candidate_title(picture).front(),
               {letters, kCandidateColour, {0.5, 1}, true});
    auto caption = match_caption(picture, chosen.size());
    caption.insert(caption.begin() + 1, motion_text(cameras.candidate_from_query));
    const auto lines = wrapped(caption, letters, width);
    const cv::Rect strip(0, drawn.rows, width, strip_height(lines.size(), letters));
    cv::copyMakeBorder(
        drawn, drawn, 0, strip.height, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(255));
    draw_strip(drawn, strip, lines, letters);
    return drawn;
}

}  // namespace fild
