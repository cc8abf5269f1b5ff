// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/synthetic_options.h"

#include <algorithm>
#include <stdexcept>

namespace fild
{
std::vector<std::pair<std::string, Options*>> TSyntheticOptions::sections()
{
    return {{"town", &town},
            {"route", &route},
            {"conditions", &conditions},
            {"sensors", &sensors},
            {"truth", &truth}};
}

void TSyntheticOptions::check() const
{
    auto copy = *this;
    for (const auto& [section, options] : copy.sections())
    {
        try
        {
            options->check();
        }
        catch (const std::invalid_argument& error)
        {
            throw std::invalid_argument("[" + section + "] " + error.what());
        }
    }
}

std::vector<std::string> preset_names()
{
    return {"tiny", "demo", "hard", "large"};
}

Preset preset_named(const std::string& name)
{
    const auto names = preset_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::invalid_argument("no preset is named '" + name + "'");
    return static_cast<Preset>(found - names.begin());
}

TSyntheticOptions options_of(Preset preset)
{
    TSyntheticOptions options;
    switch (preset)
    {
        case Preset::tiny:
            options.town.columns = 1;
            options.town.block_length_m = options.town.block_width_m = 30;
            options.route.circuit_columns = 1;
            options.route.speed_m_per_s = 8;
            options.route.frames_per_second = 0.75;
            options.sensors.width = 320;
            options.sensors.height = 240;
            break;
        case Preset::demo:
            options.route.speed_m_per_s = 6;
            break;
        case Preset::hard:
            options.town.look_alike_variation = 0.7;
            options.route.speed_m_per_s = 6;
            options.route.lap_offset_m = 2.5;
            options.route.lap_view_deg = 25;
            options.conditions.light_change = 0.45;
            options.conditions.occluders = 0.8;
            options.conditions.season_change = 0.8;
            break;
        case Preset::large:
            options.town.columns = 5;
            options.town.rows = 4;
            options.route.laps = 4;
            options.route.circuit_columns = 5;
            options.route.circuit_rows = 3;
            break;
    }
    return options;
}

}  // namespace fild
