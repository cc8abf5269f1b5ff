// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fild
{
enum class WallKind
{
    brick,
    plaster,
    ashlar,
    boards
};

enum class WindowKind
{
    casement,
    sash,
    shuttered,
    arched,
    wide
};

/** How a house front was built; look-alikes share it. Lengths in metres. Value type. */
struct FacadeDesign
{
    double width = 10;
    int floors = 4;
    double floor_height = 3;
    WallKind wall = WallKind::plaster;
    Colour wall_colour;
    Colour trim_colour;  ///< frames, cornices
    Colour accent_colour;  ///< shutters, doors, shop front
    WindowKind window = WindowKind::casement;
    int windows_per_floor = 3;
    cv::Size2d window_size;
    bool shop = false;
    std::string sign;
    bool awning = false;
    int balcony_floor = 0;  ///< 0: none
    int roof = 0;  ///< which of the roof textures
    double soot = 0;  ///< how much darker than painted, [0, 1)

    double height() const { return floors * floor_height + 0.8; }
};

/** Colours of walls, and of cloth. */
const std::vector<Colour>& wall_colours();

/** Draws a design. */
FacadeDesign design_facade(double width, Lot& lot);

/** A house of the same plan, as its owners have changed it: other plaster, paint, sign or awning,
 *  soot, and a width that differs a little. \param strength  (0, 1]. */
FacadeDesign varied(FacadeDesign design, double strength, Lot lot);

/** Paints a house front of `size` metres in that design.
 *  \param wear  seed of what time did to it: stains, curtains, boxes of flowers, wires. */
cv::Mat paint_facade(const FacadeDesign& design, double width, std::uint64_t wear);

/** Paints a wall of that house without windows, of `size` metres. */
cv::Mat paint_blank_wall(const FacadeDesign& design, const cv::Size2d& size, std::uint64_t wear);

}  // namespace fild
