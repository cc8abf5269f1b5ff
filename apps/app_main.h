// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/words.h"
#include "fild/job/error_line.h"
#include "fild/job/standard_streams.h"
#include "fild/job/wrong_usage.h"

#include <mrpt/3rdparty/tclap/CmdLine.h>

#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** Reports wrong usage as an exception; TCLAP itself would print a dozen lines and end the process.
 */
class ThrowingOutput : public TCLAP::StdOutput
{
 public:
    void failure(TCLAP::CmdLineInterface& command, TCLAP::ArgException& error) override
    {
        const auto about = name_in(error.argId());
        throw WrongUsage(in_our_words(error.error()) + ": " +
                         (about.empty() ? missing_arguments(command) : about));
    }

 private:
    static std::string in_our_words(const std::string& error)
    {
        if (error == "One or more required arguments missing!") return "missing";
        if (error == "Couldn't find match for argument") return "unknown argument";
        if (error == "Argument already set!") return "given twice";
        const std::string unmet = " does not meet constraint: ";
        const std::string value = "Value ";
        const auto at = error.find(unmet);
        if (at == std::string::npos || error.rfind(value, 0) != 0) return error;
        return error.substr(value.size(), at - value.size()) + " is not one of " +
               error.substr(at + unmet.size());
    }

    /** --list of "Argument: (--list)", "Argument: -l (--list)" and "Argument: --list"; -l of
     *  "Argument: -l"; more of "Argument: more"; empty for " ". */
    static std::string name_in(const std::string& argument)
    {
        const auto name = argument.find("--");
        const auto first = name == std::string::npos ? argument.rfind(' ') + 1 : name;
        return argument.substr(first, argument.find(')') - first);
    }

    /** "--images or --list, --output" */
    static std::string missing_arguments(TCLAP::CmdLineInterface& command)
    {
        std::vector<std::string> missing;
        std::set<const TCLAP::Arg*> of_alternatives;
        for (const auto& alternatives : command.getXorHandler().getXorList())
        {
            std::vector<std::string> names;
            bool is_given = false;
            for (const auto* arg : alternatives)
            {
                of_alternatives.insert(arg);
                names.push_back("--" + arg->getName());
                is_given = is_given || arg->isSet();
            }
            if (!is_given) missing.push_back(joined(names, " or "));
        }
        for (const auto* arg : command.getArgList())
            if (arg->isRequired() && !arg->isSet() && of_alternatives.count(arg) == 0)
                missing.push_back("--" + arg->getName());
        return joined(missing, ", ");
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
