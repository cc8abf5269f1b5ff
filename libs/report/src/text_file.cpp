// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.h"

#include "fild/core/whole_file.h"

#include <stdexcept>

namespace fild
{
std::filesystem::path make_folder(const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot make the output folder " + folder + ": " +
                                 error.message());
    return folder;
}

void write_text_file(const std::filesystem::path& path, const std::string& content)
{
    remove_unfinished_of(path.string());
    WholeFile file(path.string());
    file.stream() << content;
    file.commit();
}

}  // namespace fild
