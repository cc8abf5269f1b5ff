// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app_main.h"
#include "fild/core/ini_file.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace fild
{
/** Options of a configuration with what --set replaces.
 *  \param read  gives the configuration, anew at each call: copies share their content.
 *  \throw WrongUsage when the configuration by itself could be loaded: --set is at fault.
 *  \throw std::runtime_error when it could not. */
template <class AllOptions, class Read>
AllOptions configured(const Read& read, const std::vector<std::string>& overrides)
{
    const auto load = [](const mrpt::config::CConfigFileMemory& config)
    {
        AllOptions options;
        load_sections(config, options.sections());
        return options;
    };
    auto replaced = read();
    apply_overrides(replaced, overrides);
    try
    {
        return load(replaced);
    }
    catch (const std::runtime_error& error)
    {
        if (overrides.empty()) throw;
        load(read());
        throw WrongUsage(error.what());
    }
}

}  // namespace fild
