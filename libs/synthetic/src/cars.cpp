// SPDX-License-Identifier: BSD-3-Clause
#include "cars.h"

#include "car_models.h"
#include "wheels.h"

#include <mrpt/opengl/COpenGLScene.h>

namespace fild
{
namespace
{
void add_car_body(TexturedMesh& mesh, const PlaceFrame& frame, int index)
{
    const auto outline = car_model(index).outline;
    constexpr double kAll = 1.0 * kCarModels * kCarPixels;
    const auto side_top = index * kCarPixels / kAll;
    const auto strip_top = side_top + kCarSidePixels / kAll;
    const auto strip_height = kCarTopPixels / kAll;
    const auto corner = [&](const cv::Point2d& point, double left)
    {
        const cv::Point2d in_picture(point.x / kCarLength,
                                     side_top + (1 - point.y / kCarHeight) * kCarSidePixels / kAll);
        return Corner{frame.at(point.x - kCarLength / 2, left, point.y), in_picture};
    };
    const cv::Point2d middle(2, 0.6);
    const auto half = kCarWidth / 2;
    for (std::size_t i = 0; i <= kCarParts; ++i)
    {
        const auto& a = outline[i];
        const auto& b = outline[(i + 1) % outline.size()];
        mesh.add_triangle(corner(middle, half), corner(a, half), corner(b, half));
        mesh.add_triangle(corner(middle, -half), corner(b, -half), corner(a, -half));
        if (i == kCarParts) break;
        const auto left = static_cast<double>(i) / kCarParts;
        const auto right = static_cast<double>(i + 1) / kCarParts;
        mesh.add_quad({corner(a, -half).at, {left, strip_top + strip_height}},
                      {corner(b, -half).at, {right, strip_top + strip_height}},
                      {corner(b, half).at, {right, strip_top}},
                      {corner(a, half).at, {left, strip_top}});
    }
}

void add_wheels(TexturedMesh& mesh, const PlaceFrame& frame, Lot& lot)
{
    const auto kind = lot.whole(0, kWheelKinds - 1);
    for (const double axle : kCarAxles)
        for (const double side : {-1.0, 1.0})
            add_wheel(mesh,
                      frame,
                      {axle - kCarLength / 2, side * (kCarWidth / 2 + 0.02), kCarWheelRadius},
                      kind,
                      lot.real(0, 2 * CV_PI));
}
}  // namespace

void add_car(TexturedMesh& bodies, TexturedMesh& wheels, const StandingObject& car)
{
    Lot lot(car.seed);
    const PlaceFrame frame(car, 0);
    add_car_body(bodies, frame, lot.whole(0, kCarModels - 1));
    add_wheels(wheels, frame, lot);
}

void add_cars(mrpt::opengl::COpenGLScene& scene, const std::vector<StandingObject>& cars)
{
    TexturedMesh bodies;
    TexturedMesh wheels;
    for (const auto& car : cars) add_car(bodies, wheels, car);
    scene.insert(bodies.object(paint_cars()));
    scene.insert(wheels.object(paint_wheels()));
}

}  // namespace fild
