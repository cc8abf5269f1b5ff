// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/whole_file.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <locale>
#include <stdexcept>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fild
{
namespace
{
// No other program ends its names like this: such a file may be removed.
constexpr const char* kUnfinishedMark = ".fild-part-";

bool is_unfinished(const std::string& file_name, const std::string& of_name)
{
    const std::string mark = kUnfinishedMark;
    const auto at = file_name.rfind(mark);
    if (at == std::string::npos || at == 0) return false;
    const auto number = file_name.substr(at + mark.size());
    return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
           (of_name.empty() || file_name.compare(0, at, of_name) == 0);
}

/** \param of_name  empty: of all names. */
void remove_unfinished(const std::string& folder, const std::string& of_name)
{
    std::error_code ignored;  // a leftover harms nobody
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (is_unfinished(entry.path().filename().string(), of_name)) found.push_back(entry.path());
    for (const auto& path : found)
        if (WriteLock(path.string()).is_held()) std::filesystem::remove_all(path, ignored);
}

std::string folder_of(const std::string& path)
{
    const auto folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}
}  // namespace

std::string unfinished_path(const std::string& path)
{
    return path + kUnfinishedMark + std::to_string(::getpid());
}

WriteLock::WriteLock(const std::string& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)),
      held_(descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0)
{
}

WriteLock::~WriteLock()
{
    if (descriptor_ >= 0) ::close(descriptor_);
}

void remove_unfinished_in(const std::string& folder)
{
    remove_unfinished(folder, "");
}

void remove_unfinished_of(const std::string& path)
{
    remove_unfinished(folder_of(path), std::filesystem::path(path).filename().string());
}

void sync_to_disk(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;  // one may write and not read it: then nothing can be done
    const int error_number = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    const bool disk_failed =
        error_number == EIO || error_number == ENOSPC || error_number == EDQUOT;
    if (disk_failed)  // other errors: the file system does not know fsync()
        throw std::runtime_error("cannot write " + path +
                                 " to disk: " + std::generic_category().message(error_number));
}

WholeFile::WholeFile(std::string path)
    : path_(std::move(path)),
      temporary_path_(unfinished_path(path_)),
      stream_(temporary_path_, std::ios::binary | std::ios::trunc)
{
    if (!stream_)
        throw std::runtime_error("cannot write " + path_ + ": " +
                                 std::generic_category().message(errno));
    stream_.imbue(std::locale::classic());  // whatever the program around us has set
    lock_.emplace(temporary_path_);
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
    sync_to_disk(temporary_path_);
    std::error_code error;
    std::filesystem::rename(temporary_path_, path_, error);
    if (error) throw std::runtime_error("cannot rename to " + path_ + ": " + error.message());
    committed_ = true;
    sync_to_disk(folder_of(path_));
}

void write_whole_file(const std::filesystem::path& path, const std::string& content)
{
    remove_unfinished_of(path.string());
    WholeFile file(path.string());
    file.stream() << content;
    file.commit();
}

std::filesystem::path make_folder(const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot make the output folder " + folder + ": " +
                                 error.message());
    return folder;
}

void refuse_existing(const std::string& path)
{
    if (std::filesystem::exists(std::filesystem::symlink_status(path)))
        throw std::runtime_error(path + " exists already; remove it or choose another output");
}

}  // namespace fild
