// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/whole_file.h"

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fild
{
WholeFile::WholeFile(std::string path)
    : path_(std::move(path)),
      temporary_path_(path_ + ".part-" + std::to_string(::getpid())),
      stream_(temporary_path_, std::ios::binary | std::ios::trunc)
{
    if (!stream_)
        throw std::runtime_error("cannot write " + path_ + ": " +
                                 std::generic_category().message(errno));
}

WholeFile::~WholeFile()
{
    if (committed_) return;
    stream_.close();
    std::error_code ignored;  // nothing can be done about a temporary file that will not go
    std::filesystem::remove(temporary_path_, ignored);
}

void WholeFile::commit()
{
    stream_.close();
    if (!stream_)
        throw std::runtime_error("cannot write " + path_ + " to its end: is the disk full?");
    std::error_code error;
    std::filesystem::rename(temporary_path_, path_, error);
    if (error) throw std::runtime_error("cannot rename to " + path_ + ": " + error.message());
    committed_ = true;
}

void refuse_existing(const std::string& path)
{
    if (std::filesystem::exists(std::filesystem::symlink_status(path)))
        throw std::runtime_error(path + " exists already; remove it or choose another output");
}

}  // namespace fild
