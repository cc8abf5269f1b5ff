// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>

namespace fild
{
/** A file that appears under its name only when it is whole: written under a temporary name beside
 * it and renamed by commit(). Without commit(), nothing is left behind and an older file of that
 * name stays. Not thread-safe: one caller at a time. */
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

    /** Flushes, closes and renames. \throw std::runtime_error when a write had failed (disk full).
     */
    void commit();

 private:
    std::string path_;
    std::string temporary_path_;
    std::ofstream stream_;
    bool committed_ = false;
};

/** Before a file or folder is made that must not replace anything.
 *  \throw std::runtime_error when there is something of that name, a dangling link included. */
void refuse_existing(const std::string& path);

}  // namespace fild
