// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "error_line.h"
#include "standard_streams.h"

#include <mrpt/3rdparty/tclap/CmdLine.h>

#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
/** A command line that was typed wrongly. */
class WrongUsage : public std::invalid_argument
{
 public:
    using std::invalid_argument::invalid_argument;
};

/** Reports wrong usage as an exception; TCLAP itself would print a dozen lines and end the process.
 */
class ThrowingOutput : public TCLAP::StdOutput
{
 public:
    void failure(TCLAP::CmdLineInterface& command, TCLAP::ArgException& error) override
    {
        auto about = error.argId();  // "Argument: (--list)", or blank when one is absent
        for (const std::string around : {"Argument: ", "(", ")", " "})
            if (const auto at = about.find(around); at != std::string::npos)
                about.erase(at, around.size());
        if (about.empty())
            for (const auto* arg : command.getArgList())
                if (arg->isRequired() && !arg->isSet()) about += " --" + arg->getName();
        throw WrongUsage(error.error() + ": " + about);
    }
};

/** Reads the command line. \return false when --help or --version was all that was asked for.
 *  \throw WrongUsage */
inline bool parse_arguments(TCLAP::CmdLine& command, int argc, char** argv)
{
    ThrowingOutput output;
    const std::unique_ptr<TCLAP::CmdLineOutput> leaked_by_set_output(command.getOutput());
    command.setOutput(&output);
    return command.parse(argc, const_cast<const char**>(argv));
}

/** Calls a function whose std::invalid_argument means that the command line is wrong.
 *  \throw WrongUsage instead, with the same text. */
template <class Function>
auto as_usage(Function&& function)
{
    try
    {
        return function();
    }
    catch (const std::invalid_argument& error)
    {
        throw WrongUsage(error.what());
    }
}

/** What every app's main() does: parses, runs, and turns errors into one line on stderr.
 *  \param parse  argc, argv -> std::optional of options; nothing when there is nothing to run. Its
 *                std::invalid_argument counts as WrongUsage.
 *  \param run    options -> nothing; failures are exceptions.
 *  \return the exit status: 0 good, 1 failed, 2 wrong usage. */
template <class Parse, class Run>
int app_main(const std::string& name, int argc, char** argv, Parse&& parse, Run&& run)
{
    prepare_standard_streams();
    const WithoutMrptWarnings quiet;
    try
    {
        if (auto options = as_usage([&] { return parse(argc, argv); })) run(std::move(*options));
        require_printed();
        return 0;
    }
    catch (const WrongUsage& error)
    {
        std::cerr << name << ": " << error_line(error) << "; see --help\n";
        return 2;
    }
    catch (const std::exception& error)
    {
        std::cerr << name << ": " << error_line(error) << "\n";
        return 1;
    }
}

}  // namespace fild
