// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/standard_streams.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <stdexcept>
#include <string_view>
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

/** True when one of the two texts begins with the other. */
bool may_become(std::string_view line, std::string_view wanted)
{
    const auto common = std::min(line.size(), wanted.size());
    return line.substr(0, common) == wanted.substr(0, common);
}
}  // namespace

void prepare_standard_streams()
{
    int descriptor = ::open("/dev/null", O_RDWR);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = ::dup(descriptor);
    if (descriptor >= 0) ::close(descriptor);
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

WithoutMrptWarnings::WithoutMrptWarnings() : target_(std::cerr.rdbuf(this)) {}

WithoutMrptWarnings::~WithoutMrptWarnings()
{
    pass_on();
    std::cerr.rdbuf(target_);
}

WithoutMrptWarnings::int_type WithoutMrptWarnings::overflow(int_type character)
{
    constexpr std::string_view kWarning = "[CObservation3DRangeScan] Warning: autofixing";
    if (traits_type::eq_int_type(character, traits_type::eof()))
        return traits_type::not_eof(character);
    line_ += traits_type::to_char_type(character);
    const bool is_warning = may_become(line_, kWarning);
    const bool has_ended = line_.back() == '\n';
    if (!is_warning)
        pass_on();
    else if (has_ended)
        line_.clear();
    return character;
}

int WithoutMrptWarnings::sync()
{
    return target_->pubsync();
}

void WithoutMrptWarnings::pass_on()
{
    target_->sputn(line_.data(), static_cast<std::streamsize>(line_.size()));
    line_.clear();
}

void require_printed()
{
    std::cout.flush();
    const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (!arrived && !has_no_reader(STDOUT_FILENO))
        throw std::runtime_error("cannot write to the standard output: is the disk full?");
}

}  // namespace fild
