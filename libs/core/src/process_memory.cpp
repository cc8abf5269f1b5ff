// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/process_memory.h"

#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace fild
{
std::optional<std::size_t> resident_memory_bytes()
{
    std::ifstream file("/proc/self/statm");
    std::size_t total_pages = 0;
    std::size_t resident_pages = 0;
    if (!(file >> total_pages >> resident_pages)) return std::nullopt;
    return resident_pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::size_t peak_memory_bytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

}  // namespace fild
