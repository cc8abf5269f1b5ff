// SPDX-License-Identifier: BSD-3-Clause
#include "wheels.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace fild
{
namespace
{
constexpr int kWheelPixels = 64;

void paint_wheel(cv::Mat&& wheel, Lot& lot)
{
    const cv::Point middle(kWheelPixels / 2, kWheelPixels / 2);
    wheel = cv::Scalar(28, 28, 30);
    const auto light = lot.real(90, 190);
    const auto rim = lot.whole(16, 23);
    cv::circle(wheel, middle, rim, cv::Scalar::all(light), cv::FILLED, cv::LINE_AA);
    const auto spokes = lot.whole(3, 9);
    const auto turn = lot.real(0, 2 * CV_PI);
    for (int spoke = 0; spoke < spokes; ++spoke)
    {
        const auto angle = turn + 2 * CV_PI * spoke / spokes;
        const cv::Point out(cvRound(rim * std::cos(angle)), cvRound(rim * std::sin(angle)));
        cv::line(wheel,
                 middle,
                 middle + out,
                 cv::Scalar::all(light * 0.3),
                 lot.whole(2, 5),
                 cv::LINE_AA);
    }
    cv::circle(wheel, middle, lot.whole(3, 8), cv::Scalar::all(light * 0.8), cv::FILLED);
}
}  // namespace

cv::Mat paint_wheels()
{
    Lot lot(72);
    cv::Mat picture(kWheelKinds * kWheelPixels, kWheelPixels, CV_8UC3);
    for (int kind = 0; kind < kWheelKinds; ++kind)
        paint_wheel(picture.rowRange(kind * kWheelPixels, (kind + 1) * kWheelPixels), lot);
    add_grain(picture, 8, lot);
    return picture;
}

void add_wheel(
    TexturedMesh& mesh, const PlaceFrame& frame, const WheelPlace& place, int kind, double turned)
{
    constexpr int kSides = 14;
    const auto side = place.left > 0 ? 1.0 : -1.0;
    const auto in_picture = [&](double angle, double radius)
    {
        return cv::Point2d(0.5 + 0.5 * radius * std::cos(angle + turned),
                           (kind + 0.5 + 0.49 * radius * std::sin(angle + turned)) / kWheelKinds);
    };
    const auto rim = [&](int index)
    {
        const auto angle = side * 2 * CV_PI * index / kSides;
        return Corner{frame.at(place.ahead + place.radius * std::cos(angle),
                               place.left,
                               place.radius * (1 - std::sin(angle))),
                      in_picture(angle, 1)};
    };
    const Corner hub{frame.at(place.ahead, place.left, place.radius), in_picture(0, 0)};
    for (int i = 0; i < kSides; ++i) mesh.add_triangle(hub, rim(i), rim(i + 1));
}

}  // namespace fild
