// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace fild
{
/** The name of a file or folder until it is whole: `PATH.fild-part-PID` of this process. */
std::string unfinished_path(const std::string& path);

/** Marks a file or folder as being written: an flock() that ends with this object, or with the
 *  process however that ends. Not thread-safe: one caller at a time. */
class WriteLock
{
 public:
    /** \param path  an existing file or folder. Where it cannot be locked, it stays unlocked. */
    explicit WriteLock(const std::string& path);
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;
    ~WriteLock();

    /** False where another WriteLock holds it, or the file system has no locks. */
    bool is_held() const { return held_; }

 private:
    int descriptor_ = -1;
    bool held_ = false;
};

/** Removes what killed processes left unfinished in a folder: files and folders that have a name of
 *  unfinished_path() and that no WriteLock holds. Ignores failures. */
void remove_unfinished_in(const std::string& folder);

/** Removes only what was to become this path. Ignores failures. */
void remove_unfinished_of(const std::string& path);

/** Writes a file, or the list of names of a folder, from the system's memory to the disk.
 *  \throw std::runtime_error when the disk reports an error. */
void sync_to_disk(const std::string& path);

/** A file that appears under its name only when it is whole and on the disk: it is written as
 *  unfinished_path() and renamed by commit(). Without commit(), nothing is left behind and an older
 *  file of that name stays. Not thread-safe: one caller at a time. */
class WholeFile
{
 public:
    /** \throw std::runtime_error when the file cannot be created, with path and reason. */
    explicit WholeFile(std::string path);
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile();

    std::ostream& stream() { return stream_; }
    const std::string& temporary_path() const { return temporary_path_; }

    /** Flushes, closes, syncs to disk and renames.
     *  \throw std::runtime_error when a write had failed (disk full). */
    void commit();

 private:
    std::string path_;
    std::string temporary_path_;
    std::ofstream stream_;
    std::optional<WriteLock> lock_;
    bool committed_ = false;
};

/** Writes a file whole or not at all; what a killed process left of it is removed.
 *  \throw std::runtime_error as WholeFile. */
void write_whole_file(const std::filesystem::path& path, const std::string& content);

/** Makes the folder if need be. \throw std::runtime_error naming it. */
std::filesystem::path make_folder(const std::string& folder);

/** Before a file or folder is made that must not replace anything.
 *  \throw std::runtime_error when there is something of that name, a dangling link included. */
void refuse_existing(const std::string& path);

}  // namespace fild
