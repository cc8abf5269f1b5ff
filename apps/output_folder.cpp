// SPDX-License-Identifier: BSD-3-Clause
#include "output_folder.h"

#include "fild/core/whole_file.h"

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
namespace
{
std::string reason(int error_number)
{
    return std::generic_category().message(error_number);
}
}  // namespace

OutputFolder::OutputFolder(std::string path) : path_(std::move(path))
{
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error)
        throw std::runtime_error("cannot make the output folder " + path_ + ": " + error.message());
    lock_ = ::open(file(".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock_ < 0)
        throw std::runtime_error("cannot write into the output folder " + path_ + ": " +
                                 reason(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0)
    {
        const int error_number = errno;
        ::close(lock_);
        throw std::runtime_error(error_number == EWOULDBLOCK
                                     ? "another run is writing into " + path_ +
                                           "; wait for it or choose another --output"
                                     : "cannot lock " + path_ + ": " + reason(error_number));
    }
    remove_unfinished_in(path_);
}

// The lock file stays: to remove it would let two runs lock two files of one name.
OutputFolder::~OutputFolder()
{
    ::close(lock_);
}

std::string OutputFolder::file(const std::string& name) const
{
    return (std::filesystem::path(path_) / name).string();
}

}  // namespace fild
