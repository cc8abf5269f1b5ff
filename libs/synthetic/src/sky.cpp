// SPDX-License-Identifier: BSD-3-Clause
#include "sky.h"

#include "surface.h"
#include "textured_mesh.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** Blue that pales towards the horizon, with clouds. */
cv::Mat paint_sky(std::uint64_t seed)
{
    Lot lot(seed);
    const cv::Size size(2048, 512);
    cv::Mat noise = fractal_noise({size.width / 2, size.height}, 200, lot);
    cv::Mat mirrored;
    cv::flip(noise, mirrored, 1);
    cv::hconcat(noise, mirrored, noise);  // no seam where the ends meet
    cv::Mat sky(size, CV_8UC3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
        {
            const auto height = 1 - static_cast<double>(y) / size.height;
            const Colour blue(235 - 25 * height, 205 - 65 * height, 180 - 90 * height);
            const auto cloud =
                std::min(1.0, std::max(0.0, 0.9 * static_cast<double>(noise.at<float>(y, x))));
            const Colour mixed = blue * (1 - cloud) + Colour(245, 243, 240) * cloud;
            sky.at<cv::Vec3b>(y, x) = mixed;
        }
    return sky;
}
}  // namespace

mrpt::opengl::CSetOfTexturedTriangles::Ptr sky_dome(std::uint64_t seed)
{
    constexpr int kAround = 32;
    constexpr int kUp = 8;
    TexturedMesh mesh;  // its top is the upper edge of the picture
    const auto corner = [](int around, int up)
    {
        const auto azimuth = 2 * CV_PI * around / kAround;
        const auto elevation = CV_PI / 2 * up / kUp - 0.1;
        return Corner{kSkyRadius * cv::Point3d(std::cos(elevation) * std::cos(azimuth),
                                               std::cos(elevation) * std::sin(azimuth),
                                               std::sin(elevation)),
                      {static_cast<double>(around) / kAround,
                       1 - static_cast<double>(up) / kUp * 0.98 - 0.01}};
    };
    for (int around = 0; around < kAround; ++around)
        for (int up = 0; up < kUp; ++up)
        {
            const auto next = around + 1;
            mesh.add_triangle(corner(next, up), corner(around, up), corner(around, up + 1));
            mesh.add_triangle(corner(next, up), corner(around, up + 1), corner(next, up + 1));
        }
    return mesh.object(paint_sky(seed), false);
}

}  // namespace fild
