// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "town_plan.h"

#include <vector>

namespace mrpt::opengl
{
class COpenGLScene;
}

namespace fild
{
/** What a season has made of one tree. Value type. */
struct Foliage
{
    double density = 1;  ///< share of the leaves that is left, [0, 1]
    int colour = 0;  ///< 0: green; others: kAutumnColours
};
constexpr int kAutumnColours = 2;  ///< yellow and rust

/** \param season  0: summer, all trees green; 1: late autumn, most of them turned or bare. */
Foliage foliage_of(const StandingObject& tree, double season);

/** Trees with the foliage of a season, see foliage_of(). */
void add_trees(mrpt::opengl::COpenGLScene& scene,
               const std::vector<StandingObject>& trees,
               double season);

}  // namespace fild
