// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/whole_folder.h"

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace fild
{
namespace fs = std::filesystem;

WholeFolder::WholeFolder(fs::path path)
    : path_(std::move(path)), location_(unfinished_path(path_.string()))
{
    std::error_code error;
    fs::create_directory(location_, error);
    if (error) throw std::runtime_error("cannot make " + path_.string() + ": " + error.message());
    lock_.emplace(location_.string());
}

WholeFolder::~WholeFolder()
{
    if (keep_) return;
    std::error_code ignored;  // nothing can be done about a temporary folder that will not go
    fs::remove_all(location_, ignored);
}

void WholeFolder::commit()
{
    for (const auto& entry : fs::directory_iterator(location_)) sync_to_disk(entry.path().string());
    sync_to_disk(location_.string());
    std::error_code error;
    fs::rename(location_, path_, error);
    if (error)
        throw std::runtime_error("cannot rename to " + path_.string() + ": " + error.message());
    location_ = path_;
    sync_to_disk(path_.has_parent_path() ? path_.parent_path().string() : ".");
}

}  // namespace fild
