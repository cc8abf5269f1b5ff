// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/whole_folder.h"

#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fild
{
namespace fs = std::filesystem;

WholeFolder::WholeFolder(fs::path path)
    : path_(std::move(path)), location_(path_.string() + ".part-" + std::to_string(::getpid()))
{
    std::error_code error;
    fs::create_directory(location_, error);
    if (error) throw std::runtime_error("cannot make " + path_.string() + ": " + error.message());
}

WholeFolder::~WholeFolder()
{
    if (keep_) return;
    std::error_code ignored;  // nothing can be done about a temporary folder that will not go
    fs::remove_all(location_, ignored);
}

void WholeFolder::commit()
{
    std::error_code error;
    fs::rename(location_, path_, error);
    if (error)
        throw std::runtime_error("cannot rename to " + path_.string() + ": " + error.message());
    location_ = path_;
}

}  // namespace fild
