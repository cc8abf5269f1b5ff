// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/town_options.h"

namespace fild
{
void TTownOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("seed", seed, 0, 2147483647);
    visitor.integer("columns", columns, 1, 5);
    visitor.integer("rows", rows, 1, 4);
    visitor.real("block_length_m", block_length_m, 30, 120);
    visitor.real("block_width_m", block_width_m, 30, 120);
    visitor.real("look_alikes", look_alikes, 0, 1);
    visitor.real("look_alike_variation", look_alike_variation, 0, 1);
}

StreetGrid TTownOptions::street_grid() const
{
    StreetGrid grid;
    grid.columns = columns;
    grid.rows = rows;
    grid.block_length = block_length_m;
    grid.block_width = block_width_m;
    return grid;
}

}  // namespace fild
