// SPDX-License-Identifier: BSD-3-Clause
#include "standard_streams.h"

#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <stdexcept>
#include <unistd.h>

namespace fild
{
namespace
{
bool has_no_reader(int descriptor)
{
    struct pollfd polled = {descriptor, POLLOUT, 0};
    return ::poll(&polled, 1, 0) == 1 && (polled.revents & POLLERR) != 0;
}
}  // namespace

void prepare_standard_streams()
{
    int descriptor = ::open("/dev/null", O_RDWR);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = ::dup(descriptor);
    if (descriptor >= 0) ::close(descriptor);
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void require_printed()
{
    std::cout.flush();
    const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (!arrived && !has_no_reader(STDOUT_FILENO))
        throw std::runtime_error("cannot write to the standard output: is the disk full?");
}

}  // namespace fild
