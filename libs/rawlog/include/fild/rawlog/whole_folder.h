// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

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

    /** Gives the folder its name. \throw std::runtime_error. */
    void commit();
    /** The folder is to stay when this object goes. */
    void keep() { keep_ = true; }

 private:
    std::filesystem::path path_;
    std::filesystem::path location_;
    bool keep_ = false;
};

}  // namespace fild
