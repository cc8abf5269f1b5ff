// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/3rdparty/tclap/CmdLine.h>

#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

namespace fild
{
/** A command line that was typed wrongly. */
class WrongUsage : public std::runtime_error
{
 public:
    using std::runtime_error::runtime_error;
};

/** Reports wrong usage as an exception; TCLAP itself would print a dozen lines and end the process.
 */
class ThrowingOutput : public TCLAP::StdOutput
{
 public:
    void failure(TCLAP::CmdLineInterface&, TCLAP::ArgException& error) override
    {
        throw WrongUsage(error.error() + " (" + error.argId() + ")");
    }
};

/** Reads the command line. \return false when --help or --version was all that was asked for.
 *  \throw WrongUsage */
inline bool parse_arguments(TCLAP::CmdLine& command, int argc, char** argv)
{
    ThrowingOutput output;
    command.setOutput(&output);
    return command.parse(argc, const_cast<const char**>(argv));
}

/** What every app's main() does: parses, runs, and turns errors into one line on stderr.
 *  \param parse  argc, argv -> std::optional of options; nothing when there is nothing to run.
 *  \param run    options -> nothing; failures are exceptions.
 *  \return the exit status: 0 good, 1 failed, 2 wrong usage. */
template <class Parse, class Run>
int app_main(const std::string& name, int argc, char** argv, Parse&& parse, Run&& run)
{
    try
    {
        if (auto options = parse(argc, argv)) run(std::move(*options));
        return 0;
    }
    catch (const WrongUsage& error)
    {
        std::cerr << name << ": " << error.what() << "; see --help\n";
        return 2;
    }
    catch (const std::exception& error)
    {
        std::cerr << name << ": " << error.what() << "\n";
        return 1;
    }
}

}  // namespace fild
