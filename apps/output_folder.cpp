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
namespace
{
std::string reason(int error_number)
{
    return std::generic_category().message(error_number);
}

/** Is it named `NAME.part-PID`, as WholeFile does until a file is whole? */
bool is_unfinished(const std::string& name)
{
    const std::string mark = ".part-";
    const auto at = name.rfind(mark);
    return at != std::string::npos && at > 0 && at + mark.size() < name.size() &&
           name.find_first_not_of("0123456789", at + mark.size()) == std::string::npos;
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
    remove_unfinished_files();
}

// The lock file stays: to remove it would let two runs lock two files of one name.
OutputFolder::~OutputFolder()
{
    ::close(lock_);
}

void OutputFolder::remove_unfinished_files() const
{
    std::error_code ignored;  // they are in nobody's way
    for (const auto& entry : std::filesystem::directory_iterator(path_, ignored))
        if (is_unfinished(entry.path().filename().string()))
            std::filesystem::remove(entry.path(), ignored);
}

std::string OutputFolder::file(const std::string& name) const
{
    return (std::filesystem::path(path_) / name).string();
}

}  // namespace fild
