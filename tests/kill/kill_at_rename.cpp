// SPDX-License-Identifier: BSD-3-Clause
// To be preloaded: ends the process at the n-th rename, before or after it is done.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

namespace
{
/** 0 where the variable is not set. */
int number_in(const char* variable)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? 0 : std::atoi(text);
}

void end_at(int renames, const char* variable)
{
    if (renames == number_in(variable)) std::raise(SIGKILL);
}
}  // namespace

extern "C" int rename(const char* from, const char* to) noexcept
{
    static int renames = 0;
    using Rename = int (*)(const char*, const char*);
    static const auto system_rename = reinterpret_cast<Rename>(dlsym(RTLD_NEXT, "rename"));
    ++renames;
    end_at(renames, "KILL_BEFORE_RENAME");
    const int result = system_rename(from, to);
    end_at(renames, "KILL_AFTER_RENAME");
    return result;
}
