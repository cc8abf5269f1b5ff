// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kinds.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace fild::fuzz
{
/** What to try. Value type. */
struct Plan
{
    Kind kind = Kind::rawlog;
    std::string name;  ///< of the kind
    std::uint64_t seed = 1;
    std::uint64_t first = 0;  ///< number of the first file
    std::uint64_t count = 0;  ///< at most
    std::chrono::steady_clock::time_point end;
    std::string findings;  ///< folder for the files that show a fault
};

/** What came of it. Value type. */
struct Outcome
{
    std::uint64_t tried = 0;
    std::uint64_t refused = 0;  ///< with an error, as most should be
    std::vector<std::string> findings;  ///< a line each
    long peak_megabytes = 0;  ///< of the reading process, or one that it started
};

/** Damages and reads one file after the other in processes of their own. A crash, 20 s of computing
 *  for one file, more than 1 GB, an error of several lines or lost entries are findings. The same
 *  seed and number make the same file. */
Outcome try_files(const Plan& plan);

}  // namespace fild::fuzz
