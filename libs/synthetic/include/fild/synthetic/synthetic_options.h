// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/lap_conditions.h"
#include "fild/synthetic/overlap_loops.h"
#include "fild/synthetic/route.h"
#include "fild/synthetic/sensors.h"
#include "fild/synthetic/town_options.h"

#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** All options of a synthetic recording. [town] seed is the seed of everything. Value type. */
struct TSyntheticOptions
{
    TTownOptions town;
    TRouteOptions route;
    TConditionsOptions conditions;
    TSensorOptions sensors;
    TTruthOptions truth;

    /** The sections of the .ini file that they are. */
    std::vector<std::pair<std::string, Options*>> sections();
    /** \throw std::invalid_argument as Options::check() of each, naming the section too. */
    void check() const;
};

/** Recordings to begin from. */
enum class Preset
{
    tiny,  ///< for tests: two short laps, some 60 small frames
    demo,  ///< two laps, some 420 frames of 640x480
    /** As demo, as hard as real streets: the second lap in the other lane, with the view turned, in
     *  another season, behind people and vehicles. */
    hard,
    large  ///< four laps round the largest town, some 2,100 frames of 640x480
};

/** The enumerators' names, in their order. */
std::vector<std::string> preset_names();

/** \throw std::invalid_argument for a name that no preset has. */
Preset preset_named(const std::string& name);

/** The options of a preset; all that it does not need otherwise have their defaults. */
TSyntheticOptions options_of(Preset preset);

}  // namespace fild
