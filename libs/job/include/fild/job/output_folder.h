// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** The folder that receives results, made if need be and held against a second run while this
 *  object lives. What a killed run left unfinished in it is removed.
 *  Not thread-safe: one caller at a time. */
class OutputFolder
{
 public:
    /** \throw std::runtime_error when the folder cannot be made or written, or another run holds
     * it. */
    explicit OutputFolder(std::string path);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

    std::string file(const std::string& name) const;

 private:
    void unlock() const;

    std::string path_;
    std::string lock_file_;
    int lock_ = -1;  ///< descriptor of the lock file
};

}  // namespace fild
