// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/synthetic/street_grid.h"

namespace fild
{
/** Section [town] of synthetic-rawlog: what stands in the town, the same in every lap. */
struct TTownOptions : Options
{
    int seed = 1;  ///< of everything that is drawn by lot
    int columns = 3;  ///< house blocks along x
    int rows = 2;  ///< house blocks along y
    double block_length_m = 70;  ///< along x, of the house fronts
    double block_width_m = 50;  ///< along y
    /** Share of the house rows that repeat the design of another row, house by house: the same
     *  walls, windows, shops and signs; only stains, curtains and what stands in front differ. */
    double look_alikes = 0.3;

    /** How much the houses of look-alike rows differ all the same: 0 not at all; 1 by other
     * colours, signs and awnings on most of them, soot, and up to 12 % in width. */
    double look_alike_variation = 0;

    /** The streets of the town. */
    StreetGrid street_grid() const;

 protected:
    void describe(OptionVisitor& visitor) override;
};

}  // namespace fild
