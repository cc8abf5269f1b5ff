// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kinds.h"

#include <stdexcept>

namespace fild::fuzz
{
/** Reading went on as if nothing were, or lost what was good. */
class Finding : public std::exception
{
 public:
    explicit Finding(std::string what) : what_(std::move(what)) {}
    const char* what() const noexcept override { return what_.c_str(); }

 private:
    std::string what_;
};

/** Reads a file as the apps do.
 *  \param good_entries  at least so many entries of a rawlog must be read.
 *  \throw Finding \throw std::exception when the file is refused, as it may be. */
void read_file(Kind kind,
               const std::string& reader,
               const std::string& path,
               std::size_t good_entries);

}  // namespace fild::fuzz
