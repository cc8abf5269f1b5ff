// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fild
{
/** Reads an .ini file into memory. A line `base = FILE` before the first section, FILE beside this
 *  one, takes over that file, which has no base itself; what stands in this one counts more.
 *  Refuses what MRPT's reader would let pass in silence: a missing file, a line that is neither
 *  section, key, comment nor blank, a key outside any section, a
 * section or key that stands twice, names with capital letters. Comments: a line that starts with
 * `#`, `;` or `//`, and everything after a blank and `//` or `;` in a line; so no value can begin
 * with these. \throw std::runtime_error with path, line number and reason. */
mrpt::config::CConfigFileMemory load_ini_file(const std::string& path);

/** The same of a text. \param name  of the text, for messages. */
mrpt::config::CConfigFileMemory load_ini_text(std::string_view text, const std::string& name);

/** Applies command-line overrides, each "section.key=value", as if they stood in the file.
 *  \throw std::invalid_argument naming the first override that is not of that form. */
void apply_overrides(mrpt::config::CConfigFileMemory& config,
                     const std::vector<std::string>& overrides);

/** Loads every section that is there into its options, refusing sections that none is for.
 *  \param passed_over  sections that another reader of the same file is for: not looked into.
 *  \throw std::runtime_error naming the unknown section and the known ones, or as
 *         Options::loadFromConfigFile. */
void load_sections(const mrpt::config::CConfigFileBase& config,
                   const std::vector<std::pair<std::string, Options*>>& sections,
                   const std::vector<std::string>& passed_over = {});

}  // namespace fild
