// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/decider_options.h"

#include "fild/core/ini_file.h"

#include <mrpt/config/CConfigFile.h>

#include <filesystem>
#include <stdexcept>

namespace fild
{
DeciderOptions load_decider_options(const std::string& engine_ini, const std::string& section)
{
    namespace fs = std::filesystem;
    const auto place = engine_ini + ": [" + section + "] ";
    if (!fs::is_regular_file(engine_ini)) throw std::runtime_error(engine_ini + ": no such file");
    const mrpt::config::CConfigFile engine(engine_ini);
    DeciderOptions options;
    const int level = engine.read_int(section, "class_verbosity", options.verbosity, false);
    if (level < mrpt::system::LVL_DEBUG || level > mrpt::system::LVL_ERROR)
        throw std::runtime_error(place + "class_verbosity=" + std::to_string(level) +
                                 " outside [0, 3]");
    options.verbosity = static_cast<mrpt::system::VerbosityLevel>(level);
    const auto named = engine.read_string(section, "fild_config", "", false);
    if (named.empty())
        throw std::runtime_error(
            place + "fild_config is missing: a configuration such as config-ini/default.ini");
    auto sections = options.stream.sections();
    sections.emplace_back("graph", &options.graph);
    const auto path = fs::path(engine_ini).parent_path() / named;  // or `named`, when absolute
    load_sections(load_ini_file(path.string()), sections, {"render", "report"});
    return options;
}

}  // namespace fild
