// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/model_file.h"

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace fild
{
namespace
{
/** The folder that an environment variable names; none when it is unset or no absolute path. */
std::optional<std::filesystem::path> folder_in(const char* variable)
{
    const char* const value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): only read
    if (value == nullptr || !std::filesystem::path(value).is_absolute()) return std::nullopt;
    return value;
}

/** The XDG base directory for data, by its specification an absolute path or to be ignored. */
std::optional<std::filesystem::path> data_folder()
{
    if (auto folder = folder_in("XDG_DATA_HOME")) return folder;
    if (const auto home = folder_in("HOME")) return *home / ".local" / "share";
    return std::nullopt;
}
}  // namespace

std::string find_model_file(const std::string& name)
{
    const std::filesystem::path path(name);
    if (path.has_parent_path() || std::filesystem::exists(path)) return name;
    const auto folder = data_folder();
    return folder ? (*folder / "mrpt-fild" / path).string() : name;
}

}  // namespace fild
