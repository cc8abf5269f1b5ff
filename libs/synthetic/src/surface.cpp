// SPDX-License-Identifier: BSD-3-Clause
#include "surface.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** White noise of deviation 1. */
cv::Mat white_noise(const cv::Size& size, Lot& lot)
{
    cv::Mat noise(size, CV_32F);
    cv::RNG generator(lot.seed());
    generator.fill(noise, cv::RNG::NORMAL, 0, 1);
    return noise;
}
}  // namespace

cv::Mat fractal_noise(const cv::Size& size, double coarsest_px, Lot& lot)
{
    cv::Mat sum = cv::Mat::zeros(size, CV_32F);
    double weight = 1;
    double squares = 0;
    for (double step = coarsest_px; step >= 2; step /= 2, weight /= 2)
    {
        const cv::Size cells(static_cast<int>(size.width / step) + 2,
                             static_cast<int>(size.height / step) + 2);
        cv::Mat octave;
        cv::resize(white_noise(cells, lot), octave, size, 0, 0, cv::INTER_CUBIC);
        sum += weight * octave;
        squares += weight * weight;
    }
    return sum / std::sqrt(std::max(squares, 1e-9));
}

void shade(cv::Mat& canvas, const cv::Mat& noise, double strength)
{
    for (int y = 0; y < canvas.rows; ++y)
        for (int x = 0; x < canvas.cols; ++x)
        {
            const auto factor = 1 + static_cast<float>(strength) * noise.at<float>(y, x);
            auto& pixel = canvas.at<cv::Vec3b>(y, x);
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] =
                    cv::saturate_cast<uchar>(static_cast<float>(pixel[channel]) * factor);
        }
}

void add_grain(cv::Mat& canvas, double deviation, Lot& lot)
{
    const auto noise = white_noise(canvas.size(), lot);
    for (int y = 0; y < canvas.rows; ++y)
        for (int x = 0; x < canvas.cols; ++x)
        {
            const auto offset = static_cast<float>(deviation) * noise.at<float>(y, x);
            auto& pixel = canvas.at<cv::Vec3b>(y, x);
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] =
                    cv::saturate_cast<uchar>(static_cast<float>(pixel[channel]) + offset);
        }
}

cv::Mat paint_mottled(const cv::Size& size, const Colour& colour, double strength, Lot& lot)
{
    cv::Mat picture(size, CV_8UC3, scalar(colour));
    shade(picture, fractal_noise(size, 32, lot), strength);
    add_grain(picture, 8, lot);
    return picture;
}

void lay_bricks(cv::Mat& canvas,
                const cv::Rect& area,
                const cv::Size& brick,
                const Colour& colour,
                const Colour& mortar,
                Lot& lot)
{
    auto wall = canvas(area & cv::Rect({0, 0}, canvas.size()));
    wall = scalar(mortar);
    for (int row = 0; row * brick.height < wall.rows; ++row)
        for (int x = row % 2 == 0 ? 0 : -brick.width / 2; x < wall.cols; x += brick.width)
        {
            const cv::Rect place(x, row * brick.height, brick.width - 1, brick.height - 1);
            const auto tone = brighter(colour, lot.real(0.78, 1.18));
            cv::rectangle(wall, place, scalar(tone), cv::FILLED);
        }
}

void tint(cv::Mat& canvas, const cv::Rect& area, double factor)
{
    auto part = canvas(area & cv::Rect({0, 0}, canvas.size()));
    part.convertTo(part, -1, factor);
}

void add_stains(cv::Mat& canvas, int count, int largest_px, Lot& lot)
{
    for (int i = 0; i < count; ++i)
    {
        const int radius = lot.whole(2, std::max(2, largest_px));
        const cv::Point centre(lot.whole(0, canvas.cols - 1), lot.whole(0, canvas.rows - 1));
        const cv::Rect box(centre.x - radius, centre.y - radius, 2 * radius + 1, 2 * radius + 1);
        auto part = canvas(box & cv::Rect({0, 0}, canvas.size()));
        cv::Mat stained = part.clone();
        const cv::Size axes(radius, std::max(1, cvRound(radius * lot.real(0.3, 1))));
        cv::ellipse(stained,
                    centre - (box & cv::Rect({0, 0}, canvas.size())).tl(),
                    axes,
                    lot.real(0, 180),
                    0,
                    360,
                    cv::Scalar::all(lot.real(20, 200)),
                    cv::FILLED,
                    cv::LINE_AA);
        const auto opacity = lot.real(0.1, 0.4);
        cv::addWeighted(stained, opacity, part, 1 - opacity, 0, part);
    }
}

}  // namespace fild
