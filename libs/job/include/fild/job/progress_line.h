// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace fild
{
/** Tells the user on stderr how far the run is: one line that rewrites itself on a terminal, one
 * line each 5 % elsewhere, nothing when quiet. Not thread-safe: one caller at a time. */
class ProgressLine
{
 public:
    /** \param found  what is counted beside frames: "loop closures". */
    ProgressLine(bool quiet, std::string found);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine();  ///< ends the line on a terminal

    /** \param fraction  share of the work done, [0, 1]. */
    void update(double fraction, std::size_t frames, std::size_t found);

 private:
    bool is_due(double fraction);
    double seconds() const;

    enum class Output
    {
        none,
        terminal,
        file
    };
    static Output output_for(bool quiet);

    Output output_;
    std::string found_;
    bool written_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double first_fraction_ = -1;  ///< of the first update: a block of the rawlog is read ahead
    double next_seconds_ = 0;
    double next_fraction_ = 0.05;
};

/** Tells the user on a terminal, in a line of its own, which step without a progress line begins;
 *  nothing elsewhere, or when quiet. */
void say_on_terminal(bool quiet, const std::string& step);

}  // namespace fild
