// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/offscreen_renderer.h"

#include "message_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTexturedTriangles.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace
{
using mrpt::math::TPoint3Df;

fild::CameraModel small_camera()
{
    fild::CameraModel camera;
    camera.fx = 150;
    camera.fy = 140;
    camera.cx = 83;
    camera.cy = 55;
    camera.width = 160;
    camera.height = 120;
    return camera;
}

/** A rectangle facing the camera at (x, y, z), `side` metres wide, in the camera's frame. */
mrpt::opengl::CSetOfTexturedTriangles::Ptr square(float x, float y, float z, float side)
{
    const auto half = side / 2;
    const TPoint3Df a(x - half, y - half, z);
    const TPoint3Df b(x + half, y - half, z);
    const TPoint3Df c(x + half, y + half, z);
    const TPoint3Df d(x - half, y + half, z);
    auto object = mrpt::opengl::CSetOfTexturedTriangles::Create();
    object->insertTriangle(mrpt::opengl::TTriangle(a, b, c));
    object->insertTriangle(mrpt::opengl::TTriangle(a, c, d));
    cv::Mat white(8, 8, CV_8UC3, cv::Scalar::all(255));
    object->assignImage(mrpt::img::CImage(white, mrpt::img::DEEP_COPY));
    object->enableLight(false);
    return object;
}

std::shared_ptr<mrpt::opengl::COpenGLScene> scene_with(
    const mrpt::opengl::CSetOfTexturedTriangles::Ptr& object)
{
    auto scene = std::make_shared<mrpt::opengl::COpenGLScene>();
    scene->getViewport()->setCustomBackgroundColor({0, 0, 0});
    scene->insert(object);
    return scene;
}

/** Where a camera at `map_from_camera` sees a square around (x, y, 4): the mean over squares of
 *  several sizes, since the edges of one are seen to half a sample only. */
cv::Point2d seen_place(float x, float y, const mrpt::poses::CPose3D& map_from_camera)
{
    cv::Point2d sum;
    constexpr int kSizes = 10;
    for (int i = 0; i < kSizes; ++i)
    {
        fild::OffscreenRenderer renderer(
            scene_with(square(x, y, 4, 0.5F + 0.013F * static_cast<float>(i))));
        cv::Mat grey;
        cv::cvtColor(
            renderer.draw(small_camera(), map_from_camera).image, grey, cv::COLOR_BGR2GRAY);
        const auto moments = cv::moments(grey);
        sum += cv::Point2d(moments.m10, moments.m01) / moments.m00;
    }
    return sum / kSizes;
}

/** MRPT's shaders ask for medium precision, which would move the camera by centimetres here. */
TEST(OffscreenRenderer, IsAsExactFarFromTheOriginAsNearIt)
{
    const auto draw_at = [](float x, double heading)
    {
        const mrpt::poses::CPose3D map_from_camera =
            mrpt::poses::CPose3D(static_cast<double>(x), 10.64, 1.6, heading, 0, 0) +
            mrpt::poses::CPose3D(0, 0, 0, -CV_PI / 2, 0, -CV_PI / 2);
        auto object = square(0.3F, 0.2F, 2, 0.5F);
        object->setPose(map_from_camera);
        fild::OffscreenRenderer renderer(scene_with(object));
        return renderer.draw(small_camera(), map_from_camera);
    };
    const auto near = draw_at(0, 0);
    for (const double heading : {0.0, 1.5, 1.57, -1.57, 3.1})
    {
        const auto far = draw_at(169.47F, heading);
        // Samples on an edge may fall to either side.
        const double difference =
            cv::norm(near.image, far.image, cv::NORM_L1) / cv::sum(cv::sum(near.image))[0];
        EXPECT_LT(difference, 0.05) << heading;
        cv::Mat both = (near.depth > 0) & (far.depth > 0);
        EXPECT_LT(cv::norm(near.depth, far.depth, cv::NORM_INF, both), 0.001) << heading;
    }
}

TEST(OffscreenRenderer, DrawsWithTheFunctionsOfOsmesa)
{
    EXPECT_THAT(fild::OffscreenRenderer::gl_library(), ::testing::HasSubstr("libOSMesa"));
}

TEST(OffscreenRenderer, ProjectsAPointWhereOpenCvDoes)
{
    const auto camera = small_camera();
    for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {1.1F, -0.7F}, {-0.9F, 0.6F}})
    {
        const auto seen = seen_place(x, y, mrpt::poses::CPose3D());
        EXPECT_NEAR(seen.x, camera.fx * x / 4 + camera.cx, 0.1) << x;
        EXPECT_NEAR(seen.y, camera.fy * y / 4 + camera.cy, 0.1) << y;
    }
}

TEST(OffscreenRenderer, MovesTheCameraAndNotTheWorld)
{
    const auto camera = small_camera();
    const auto seen = seen_place(0, 0, mrpt::poses::CPose3D(0.5, 0.2, 1, 0, 0, 0));
    EXPECT_NEAR(seen.x, camera.fx * -0.5 / 3 + camera.cx, 0.1);
    EXPECT_NEAR(seen.y, camera.fy * -0.2 / 3 + camera.cy, 0.1);
}

TEST(OffscreenRenderer, MeasuresDepthAlongTheOpticalAxisAndNoneInTheSky)
{
    fild::OffscreenRenderer renderer(scene_with(square(0, 0, 4, 1)));
    const auto view = renderer.draw(small_camera(), mrpt::poses::CPose3D());
    EXPECT_NEAR(view.depth.at<float>(55, 83), 4, 0.004);
    EXPECT_NEAR(view.depth.at<float>(68, 96), 4, 0.004);
    EXPECT_EQ(view.depth.at<float>(5, 5), 0);
    EXPECT_EQ(view.image.size(), view.depth.size());
}

TEST(OffscreenRenderer, InterpolatesTheDepthOfASlantedPlaneToPixelCentres)
{
    auto floor = mrpt::opengl::CSetOfTexturedTriangles::Create();  // 1.5 m below the camera
    const TPoint3Df a(-50, 1.5F, 0);
    const TPoint3Df b(50, 1.5F, 0);
    const TPoint3Df c(50, 1.5F, 100);
    const TPoint3Df d(-50, 1.5F, 100);
    floor->insertTriangle(mrpt::opengl::TTriangle(a, b, c));
    floor->insertTriangle(mrpt::opengl::TTriangle(a, c, d));
    fild::OffscreenRenderer renderer(scene_with(floor));
    const auto camera = small_camera();
    const auto view = renderer.draw(camera, mrpt::poses::CPose3D());
    for (const int row : {70, 90, 119})
    {
        const auto expected = camera.fy * 1.5 / (row - camera.cy);
        EXPECT_NEAR(view.depth.at<float>(row, 40), expected, 0.003 * expected) << row;
    }
}

TEST(OffscreenRenderer, AveragesAFineTextureThatIsFarAway)
{
    auto object = square(0, 0, 40, 20);
    cv::Mat checks(512, 512, CV_8UC3);
    for (int y = 0; y < checks.rows; ++y)
        for (int x = 0; x < checks.cols; ++x)
            checks.at<cv::Vec3b>(y, x) = cv::Vec3b::all((x + y) % 2 == 0 ? 255 : 0);
    auto scene = scene_with(object);
    object->clearTriangles();
    for (const auto& corners : {std::array<cv::Point2f, 3>{{{0, 0}, {1, 0}, {1, 1}}},
                                std::array<cv::Point2f, 3>{{{0, 0}, {1, 1}, {0, 1}}}})
    {
        mrpt::opengl::TTriangle triangle;
        for (std::size_t i = 0; i < 3; ++i)
        {
            triangle.vertex(i) = {20 * corners[i].x - 10, 20 * corners[i].y - 10, 40};
            triangle.u(i) = corners[i].x;
            triangle.v(i) = corners[i].y;
        }
        object->insertTriangle(triangle);
    }
    object->assignImage(mrpt::img::CImage(checks, mrpt::img::DEEP_COPY));
    fild::OffscreenRenderer renderer(scene);
    const auto view = renderer.draw(small_camera(), mrpt::poses::CPose3D());
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(view.image(cv::Rect(65, 40, 30, 30)), mean, deviation);
    EXPECT_NEAR(mean[0], 127.5, 2);
    EXPECT_LT(deviation[0], 2);
}

TEST(OffscreenRenderer, SeveralLiveAndDieInAnyOrder)
{
    const auto camera = small_camera();
    auto first = std::make_unique<fild::OffscreenRenderer>(scene_with(square(0, 0, 4, 1)));
    const auto before = first->draw(camera, mrpt::poses::CPose3D());
    auto second = std::make_unique<fild::OffscreenRenderer>(scene_with(square(1, 0, 4, 1)));
    const auto other = second->draw(camera, mrpt::poses::CPose3D());
    first.reset();
    fild::OffscreenRenderer third(scene_with(square(0, 0, 4, 1)));
    EXPECT_EQ(cv::norm(third.draw(camera, mrpt::poses::CPose3D()).image, before.image), 0);
    EXPECT_EQ(cv::norm(second->draw(camera, mrpt::poses::CPose3D()).image, other.image), 0);
    EXPECT_GT(cv::norm(before.image, other.image), 0);
}

TEST(OffscreenRenderer, DrawsSeveralSizes)
{
    fild::OffscreenRenderer renderer(scene_with(square(0, 0, 4, 1)));
    auto camera = small_camera();
    EXPECT_EQ(renderer.draw(camera, mrpt::poses::CPose3D()).image.size(), cv::Size(160, 120));
    camera.width = 101;
    camera.height = 33;
    EXPECT_EQ(renderer.draw(camera, mrpt::poses::CPose3D()).image.size(), cv::Size(101, 33));
}

TEST(OffscreenRenderer, RefusesACameraItCannotDraw)
{
    fild::OffscreenRenderer renderer(scene_with(square(0, 0, 4, 1)));
    auto camera = small_camera();
    camera.lens = fild::LensModel::plumb_bob;
    EXPECT_THAT(fild::testing::message_of<std::invalid_argument>(
                    [&] { renderer.draw(camera, mrpt::poses::CPose3D()); }),
                ::testing::HasSubstr("distortion"));
    EXPECT_THAT(fild::testing::message_of<std::invalid_argument>(
                    [&] { renderer.draw({}, mrpt::poses::CPose3D()); }),
                ::testing::HasSubstr("size"));
}

}  // namespace
