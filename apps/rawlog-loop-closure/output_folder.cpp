// SPDX-License-Identifier: BSD-3-Clause
#include "output_folder.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fild
{
OutputFolder::OutputFolder(std::string path) : path_(std::move(path))
{
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error)
        throw std::runtime_error("cannot make the output folder " + path_ + ": " + error.message());
    lock_ = ::open(file(".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock_ < 0)
        throw std::runtime_error("cannot write into the output folder " + path_ + ": " +
                                 std::generic_category().message(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0)
    {
        ::close(lock_);
        throw std::runtime_error("another run is writing into " + path_ +
                                 "; wait for it or choose another --output");
    }
}

OutputFolder::~OutputFolder()
{
    ::unlink(file(".lock").c_str());
    ::close(lock_);
}

std::string OutputFolder::file(const std::string& name) const
{
    return (std::filesystem::path(path_) / name).string();
}

}  // namespace fild
