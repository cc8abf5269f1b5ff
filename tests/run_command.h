// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "temporary_folder.h"

#include <cstdlib>
#include <string>
#include <sys/wait.h>

namespace fild::testing
{
/** What a command left behind. */
struct Finished
{
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;
};

/** Runs a shell command line with nothing on its standard input. */
inline Finished run_command(const std::string& line)
{
    const TemporaryFolder folder;
    const auto redirected =
        "{ " + line + "; } >'" + folder.path("out") + "' 2>'" + folder.path("err") + "' </dev/null";
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread, and the shell does the redirections
    const int status = std::system(redirected.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            read_text(folder.path("out")),
            read_text(folder.path("err"))};
}

}  // namespace fild::testing
