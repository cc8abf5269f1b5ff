// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace fild
{
ProgressLine::ProgressLine(bool quiet, std::string found)
    : output_(output_for(quiet)), found_(std::move(found))
{
}

ProgressLine::Output ProgressLine::output_for(bool quiet)
{
    if (quiet) return Output::none;
    return ::isatty(STDERR_FILENO) == 1 ? Output::terminal : Output::file;
}

void ProgressLine::update(double fraction, std::size_t frames, std::size_t found)
{
    if (first_fraction_ < 0) first_fraction_ = fraction;
    if (output_ == Output::none || !is_due(fraction)) return;
    const bool on_terminal = output_ == Output::terminal;
    const double elapsed = seconds();
    const double done = fraction - first_fraction_;
    const double left = done > 0 ? elapsed * (1 - fraction) / done : 0;
    std::fprintf(stderr,
                 "%s%3.0f %%  frame %zu  %.1f frames/s  %zu %s  %.0f s left%s",
                 on_terminal ? "\r\033[K" : "",
                 100 * fraction,
                 frames,
                 static_cast<double>(frames) / std::max(elapsed, 1e-3),
                 found,
                 found_.c_str(),
                 left,
                 on_terminal ? "" : "\n");
    std::fflush(stderr);
    written_ = true;
}

bool ProgressLine::is_due(double fraction)
{
    constexpr double kSecondsBetween = 0.2;
    constexpr double kFractionBetween = 0.05;
    if (output_ == Output::terminal)
    {
        if (seconds() < next_seconds_) return false;
        next_seconds_ = seconds() + kSecondsBetween;
        return true;
    }
    if (fraction < next_fraction_) return false;
    next_fraction_ = (std::floor(fraction / kFractionBetween) + 1) * kFractionBetween;
    return true;
}

ProgressLine::~ProgressLine()
{
    if (output_ == Output::terminal && written_) std::fputs("\n", stderr);
}

double ProgressLine::seconds() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void say_on_terminal(bool quiet, const std::string& step)
{
    if (!quiet && ::isatty(STDERR_FILENO) == 1) std::fprintf(stderr, "%s ...\n", step.c_str());
}

}  // namespace fild
