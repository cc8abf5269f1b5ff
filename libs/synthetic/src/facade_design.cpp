// SPDX-License-Identifier: BSD-3-Clause
#include "facade.h"

#include <algorithm>

namespace fild
{
namespace
{
const std::vector<Colour>& accent_colours()
{
    static const std::vector<Colour> colours{{60, 90, 40},
                                             {110, 60, 30},
                                             {40, 40, 130},
                                             {40, 70, 100},
                                             {120, 110, 40},
                                             {50, 50, 50},
                                             {40, 120, 170},
                                             {90, 40, 90}};
    return colours;
}

const std::vector<std::string>& signs()
{
    static const std::vector<std::string> names{
        "BAKERY", "CAFE ROMA", "BOOKS",   "PHARMACY", "HOTEL",     "FLOWERS", "SHOES",
        "OPTICS", "BAR 42",    "MUSIC",   "TOYS",     "BANK",      "FISH",    "WINES",
        "PIZZA",  "TEA ROOM",  "CYCLES",  "HAIR",     "JAZZ",      "GALLERY", "TAILOR",
        "PIANOS", "MARKET",    "BUTCHER", "CINEMA",   "KEYS",      "STAMPS",  "TRAVEL",
        "RADIO",  "PAINTS",    "LAUNDRY", "ANTIQUES", "CHOCOLATE", "KEBAB",   "PRESS"};
    return names;
}
}  // namespace

const std::vector<Colour>& wall_colours()
{
    static const std::vector<Colour> colours{{95, 110, 170},
                                             {120, 150, 190},
                                             {150, 190, 215},
                                             {190, 205, 215},
                                             {165, 185, 195},
                                             {140, 175, 205},
                                             {135, 160, 175},
                                             {200, 190, 170},
                                             {110, 140, 195},
                                             {180, 180, 180}};
    return colours;
}

FacadeDesign varied(FacadeDesign design, double strength, Lot lot)
{
    design.width *= 1 + 0.12 * strength * lot.real(-1, 1);
    const auto plaster = lot.pick(wall_colours());
    const auto mixed = strength * lot.real(0.2, 0.8);
    design.wall_colour = (1 - mixed) * design.wall_colour + mixed * plaster;
    design.wall_colour = brighter(design.wall_colour, 1 + 0.2 * strength * lot.real(-1, 1));
    const auto accent = lot.pick(accent_colours());
    if (lot.chance(0.7 * strength)) design.accent_colour = accent;
    const auto sign = lot.pick(signs());
    if (lot.chance(0.8 * strength)) design.sign = sign;
    if (lot.chance(0.4 * strength)) design.awning = !design.awning;
    const auto trim = brighter(design.trim_colour, lot.real(0.75, 1.05));
    if (lot.chance(0.6 * strength)) design.trim_colour = trim;
    design.soot = strength * lot.real(0, 0.8);
    return design;
}

FacadeDesign design_facade(double width, Lot& lot)
{
    FacadeDesign design;
    design.width = width;
    design.floors = lot.whole(3, 5);
    design.floor_height = lot.real(2.8, 3.3);
    design.wall = lot.pick<WallKind>(
        {WallKind::brick, WallKind::brick, WallKind::plaster, WallKind::ashlar, WallKind::boards});
    design.wall_colour = brighter(lot.pick(wall_colours()), lot.real(0.8, 1.1));
    design.trim_colour =
        lot.chance(0.75) ? Colour(215, 225, 230) : brighter(lot.pick(accent_colours()), 1.2);
    design.accent_colour = lot.pick(accent_colours());
    design.window = lot.pick<WindowKind>({WindowKind::casement,
                                          WindowKind::sash,
                                          WindowKind::shuttered,
                                          WindowKind::arched,
                                          WindowKind::wide});
    design.windows_per_floor = std::max(2, cvRound(width / lot.real(2.4, 3.6)));
    const bool narrow = design.window == WindowKind::shuttered;
    design.window_size = {lot.real(0.9, narrow ? 1.1 : 1.5), lot.real(1.4, 1.8)};
    design.shop = lot.chance(0.5);
    design.sign = lot.pick(signs());
    design.awning = lot.chance(0.4);
    design.balcony_floor = lot.chance(0.4) ? lot.whole(1, design.floors - 1) : 0;
    design.roof = lot.whole(0, 2);
    return design;
}

}  // namespace fild
