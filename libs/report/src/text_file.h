// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace fild
{
/** Makes the folder if need be. \throw std::runtime_error naming it. */
std::filesystem::path make_folder(const std::string& folder);

/** Writes the file whole or not at all. \throw std::runtime_error naming it. */
void write_text_file(const std::filesystem::path& path, const std::string& content);

}  // namespace fild
