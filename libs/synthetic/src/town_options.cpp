// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/town_options.h"

namespace fild
{
void TTownOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("seed", seed, 0, 2147483647);
    visitor.integer("columns", columns, 1, 5);
    visitor.integer("rows", rows, 1, 4);
    visitor.real("block_length_m", block_length_m, 40, 120);
    visitor.real("block_width_m", block_width_m, 40, 120);
    visitor.real("look_alikes", look_alikes, 0, 1);
}

}  // namespace fild
