// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <array>
#include <cstdint>

namespace fild
{
constexpr double kCarLength = 4.3;
constexpr double kCarWidth = 1.72;
constexpr double kCarHeight = 1.95;  // of the tallest
constexpr double kCarWheelRadius = 0.32;
constexpr std::array<double, 2> kCarAxles{0.8, 3.4};  // m from the rear
constexpr int kCarModels = 32;
constexpr int kCarScale = 60;  // pixels per metre
constexpr int kCarSidePixels = static_cast<int>(kCarHeight * kCarScale) + 1;
constexpr int kCarTopPixels = static_cast<int>(kCarWidth * kCarScale) + 1;
constexpr int kCarPixels = kCarSidePixels + kCarTopPixels;

/** Outline of a car from the side, from the lower rear corner over the roof to the lower front
 *  one: metres from the rear, metres over the road. */
using CarOutline = std::array<cv::Point2d, 10>;
constexpr std::size_t kCarParts = 9;  // bumper, boot lid, boot, rear window, roof, ...

/** One of the kinds of car that stand in the town: 32, so that equal ones are rare. */
struct CarModel
{
    CarOutline outline;
    Colour colour;
    std::uint64_t looks = 0;
};

/** \param index  from 0 to kCarModels - 1. */
CarModel car_model(int index);

/** Side and top of every car, below each other: kCarPixels rows for each. */
cv::Mat paint_cars();

}  // namespace fild
