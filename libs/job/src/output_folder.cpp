// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/output_folder.h"

#include "fild/core/whole_file.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
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
/** The lock file, opened and locked, instead of another one. */
int locked(const std::string& folder, const std::string& lock_file, int other)
{
    if (other >= 0) ::close(other);
    const int lock = ::open(lock_file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock < 0)
        throw std::runtime_error("cannot write into the output folder " + folder + ": " +
                                 reason(errno));
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
    const int error_number = errno;
    ::close(lock);
    throw std::runtime_error(error_number == EWOULDBLOCK
                                 ? "another run is writing into " + folder +
                                       "; wait for it or choose another --output"
                                 : "cannot lock " + folder + ": " + reason(error_number));
}

/** True when the file of that name is the one that is open. */
bool is_file_of(int descriptor, const std::string& name)
{
    struct stat opened = {};
    struct stat named = {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}
}  // namespace

OutputFolder::OutputFolder(std::string path) : path_(std::move(path)), lock_file_(file(".lock"))
{
    make_folder(path_);
    // A run that ends removes its lock file, maybe after this one has opened it.
    constexpr int kTries = 10;
    for (int i = 0; i < kTries && !is_file_of(lock_, lock_file_); ++i)
        lock_ = locked(path_, lock_file_, lock_);
    if (!is_file_of(lock_, lock_file_))
    {
        ::close(lock_);
        throw std::runtime_error("cannot lock " + path_ +
                                 ": other runs begin and end there all the time");
    }
    try
    {
        remove_unfinished_in(path_);
    }
    catch (...)
    {
        unlock();
        throw;
    }
}

void OutputFolder::unlock() const
{
    ::unlink(lock_file_.c_str());
    ::close(lock_);
}

OutputFolder::~OutputFolder()
{
    unlock();
}

std::string OutputFolder::file(const std::string& name) const
{
    return (std::filesystem::path(path_) / name).string();
}

}  // namespace fild
