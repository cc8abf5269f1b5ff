// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/model_file.h"

#include <cstdlib>
#include <filesystem>

namespace fild
{
namespace
{
/** The XDG base directory for data, by its specification an absolute path or to be ignored. */
std::filesystem::path data_folder()
{
    const char* const xdg =
        std::getenv("XDG_DATA_HOME");  // NOLINT(concurrency-mt-unsafe): only read
    if (xdg != nullptr && std::filesystem::path(xdg).is_absolute()) return xdg;
    const char* const home = std::getenv("HOME");  // NOLINT(concurrency-mt-unsafe): only read
    return std::filesystem::path(home != nullptr ? home : "") / ".local" / "share";
}
}  // namespace

std::string find_model_file(const std::string& name)
{
    const std::filesystem::path path(name);
    if (path.has_parent_path() || std::filesystem::exists(path)) return name;
    return data_folder() / "mrpt-fild" / path;
}

}  // namespace fild
