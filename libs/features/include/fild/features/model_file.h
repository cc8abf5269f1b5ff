// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** Where a model file named in an .ini file is: `name` itself when it exists or has a folder in it,
 *  else the data folder that datasets-scripts/get-model.sh fills, `$XDG_DATA_HOME/mrpt-fild`
 *  (`~/.local/share/mrpt-fild`); `name` itself without a home. The result need not exist.
 *  Thread-safe. */
std::string find_model_file(const std::string& name);

}  // namespace fild
