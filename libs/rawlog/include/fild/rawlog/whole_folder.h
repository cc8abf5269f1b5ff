// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/whole_file.h"

#include <filesystem>
#include <optional>

namespace fild
{
/** A new folder that appears under its name only when commit() is called, as WholeFile does for a
 *  file. Until keep(), it is removed again with all it holds.
 *  Not thread-safe: one caller at a time. */
class WholeFolder
{
 public:
    /** \throw std::runtime_error with path and reason when the folder cannot be made. */
    explicit WholeFolder(std::filesystem::path path);
    WholeFolder(const WholeFolder&) = delete;
    WholeFolder& operator=(const WholeFolder&) = delete;
    ~WholeFolder();

    /** Where the folder is now. */
    const std::filesystem::path& location() const { return location_; }

    /** Syncs the folder and its files to disk and gives it its name. \throw std::runtime_error. */
    void commit();
    /** The folder is to stay when this object goes. */
    void keep() { keep_ = true; }

 private:
    std::filesystem::path path_;
    std::filesystem::path location_;
    std::optional<WriteLock> lock_;
    bool keep_ = false;
};

}  // namespace fild
