// SPDX-License-Identifier: BSD-3-Clause
#include "town_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fild
{
namespace
{
/** The four rows of a block; those along y stand between the ends of those along x. */
void add_block(std::vector<HouseRow>& rows, const cv::Rect2d& block)
{
    const auto left = block.x;
    const auto right = block.x + block.width;
    const auto bottom = block.y;
    const auto top = block.y + block.height;
    const auto side = block.height - 2 * kHouseDepth;
    rows.push_back({{left, bottom}, {1, 0}, block.width, true, {}});
    rows.push_back({{right, top}, {-1, 0}, block.width, true, {}});
    rows.push_back({{right, bottom + kHouseDepth}, {0, 1}, side, false, {}});
    rows.push_back({{left, top - kHouseDepth}, {0, -1}, side, false, {}});
}

/** Rows around the town, in pieces no longer than a texture can be. */
void add_surrounding_rows(std::vector<HouseRow>& rows, const StreetGrid& grid)
{
    const auto all = grid.bounds();
    const auto right = all.x + all.width;
    const auto top = all.y + all.height;
    for (int i = 0; i < grid.columns; ++i)
    {
        const auto length = all.width / grid.columns;
        rows.push_back({{right - i * length, all.y}, {-1, 0}, length, false, {}});
        rows.push_back({{all.x + i * length, top}, {1, 0}, length, false, {}});
    }
    for (int j = 0; j < grid.rows; ++j)
    {
        const auto length = all.height / grid.rows;
        rows.push_back({{all.x, all.y + j * length}, {0, 1}, length, false, {}});
        rows.push_back({{right, top - j * length}, {0, -1}, length, false, {}});
    }
}

/** Houses whose designs are repeated. */
struct RowModel
{
    std::vector<House> houses;  ///< may be empty
    double variation = 0;  ///< [town] look_alike_variation
};

/** Fills a row from left to right; the last house takes what is left.
 *  \param model  is repeated as far as it reaches. */
std::vector<House> build_row(double length, const RowModel& model, Lot& lot)
{
    constexpr double kNarrowest = 7;
    constexpr double kWidest = 13;
    std::vector<House> houses;
    double offset = 0;
    while (offset < length)
    {
        const auto index = houses.size();
        House house;
        house.offset = offset;
        const bool repeats = index < model.houses.size();
        house.design = repeats ? model.houses[index].design
                               : design_facade(lot.real(kNarrowest, kWidest), lot);
        house.wear = lot.seed();
        if (repeats && model.variation > 0)
        {
            house.design = varied(house.design, model.variation, Lot(house.wear + 2));
            house.design.width = std::max(kNarrowest, house.design.width);
        }
        const auto left_over = length - offset - house.design.width;
        if (left_over < kNarrowest) house.design.width += left_over;
        offset += house.design.width;
        houses.push_back(house);
    }
    return houses;
}

void build_rows(std::vector<HouseRow>& rows, const TTownOptions& options, Lot& lot)
{
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        RowModel model{{}, options.look_alike_variation};
        if (i > 0 && lot.chance(options.look_alikes))
            model.houses =
                rows[static_cast<std::size_t>(lot.whole(0, static_cast<int>(i) - 1))].houses;
        rows[i].houses = build_row(rows[i].length, model, lot);
    }
}

/** Places every `least` to `most` metres along a row, clear of its ends. */
std::vector<StandingObject> places_along(
    const HouseRow& row, double out, double clear, double least, double most, Lot& lot)
{
    std::vector<StandingObject> places;
    const auto heading = std::atan2(-row.along.y, -row.along.x);  // the fronts are on the right
    for (double right = clear; right < row.length - clear; right += lot.real(least, most))
        places.push_back({row.at(right, out), heading, lot.seed()});
    return places;
}

/** Whether a row passes the mouth of a street, where no car may stand. */
bool at_a_crossing(const StreetGrid& grid, const HouseRow& row, const cv::Point2d& at)
{
    constexpr double kClear = 5;
    const bool along_x = row.along.y == 0;
    const auto pitch = (along_x ? grid.block_length : grid.block_width) + grid.street_width();
    const auto from_street = std::abs(std::remainder(along_x ? at.x : at.y, pitch));
    return from_street < grid.carriageway / 2 + kClear;
}

void append(std::vector<StandingObject>& all, const std::vector<StandingObject>& more)
{
    all.insert(all.end(), more.begin(), more.end());
}
}  // namespace

TownPlan plan_town(const TTownOptions& options)
{
    TownPlan plan;
    plan.grid = options.street_grid();
    for (int i = 0; i < options.columns; ++i)
        for (int j = 0; j < options.rows; ++j) add_block(plan.rows, plan.grid.block(i, j));
    add_surrounding_rows(plan.rows, plan.grid);
    Lot lot(static_cast<std::uint64_t>(options.seed));
    build_rows(plan.rows, options, lot);
    constexpr double kBay = 6;
    const auto by_the_kerb = plan.grid.pavement - 0.6;
    const auto in_the_bay = plan.grid.pavement + 1;
    for (const auto& row : plan.rows)
    {
        append(plan.trees, places_along(row, by_the_kerb, 4, 8, 22, lot));
        append(plan.lamp_posts, places_along(row, by_the_kerb, 3, 20, 24, lot));
        for (const auto& bay : places_along(row, in_the_bay, kBay / 2, kBay, kBay, lot))
            if (!at_a_crossing(plan.grid, row, bay.at)) plan.parking_bays.push_back(bay);
    }
    return plan;
}

std::vector<StandingObject> parked_cars(const TownPlan& plan, std::uint64_t seed)
{
    constexpr double kTaken = 0.45;
    Lot lot(seed);
    std::vector<StandingObject> cars;
    for (auto bay : plan.parking_bays)
    {
        bay.seed = lot.seed();
        const bool taken = lot.chance(kTaken);
        if (taken) cars.push_back(bay);
    }
    return cars;
}

}  // namespace fild
