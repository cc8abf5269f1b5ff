// SPDX-License-Identifier: BSD-3-Clause
// rawlog-loop-closure: a rawlog in; loop closures, a map, pictures and a summary out.
#include "app_main.h"
#include "configuration.h"
#include "fild/run/loop_closure_run.h"
#include "truth_arguments.h"

#include <optional>
#include <string>
#include <string_view>

namespace fild
{
extern const std::string_view kDefaultIni;  ///< config-ini/default.ini
}

namespace
{
using Text = TCLAP::ValueArg<std::string>;

/** The words as a shell takes them apart again. */
std::string shell_line(int argc, char** argv)
{
    std::string line;
    for (int i = 0; i < argc; ++i)
    {
        const std::string word = argv[i];
        constexpr const char* kPlain =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./:=,+@%";
        const bool is_plain = !word.empty() && word.find_first_not_of(kPlain) == std::string::npos;
        line += i == 0 ? "" : " ";
        if (is_plain)
        {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
        line += '\'';
    }
    return line;
}

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<fild::RunRequest> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Finds where the camera of a rawlog returns to a known place, and makes a map of it.",
        ' ',
        FILD_VERSION);
    fild::TruthArguments truth(command, false);
    TCLAP::SwitchArg quiet("q", "quiet", "No progress line", command);
    TCLAP::ValueArg<int> max_frames(
        "n", "max-frames", "Stop after so many camera frames", false, 1, "FRAMES", command);
    TCLAP::MultiArg<std::string> overrides(
        "s", "set", "Replaces a value of the configuration", false, "section.key=value", command);
    Text output("o", "output", "Folder for the results; made if need be", true, "", "DIR", command);
    Text config("c",
                "config",
                "Configuration; default: that of config-ini/default.ini",
                false,
                "",
                "FILE.ini",
                command);
    Text rawlog("r", "rawlog", "The recording, plain or gzipped", true, "", "FILE.rawlog", command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;
    if (max_frames.getValue() < 1) throw fild::WrongUsage("--max-frames must be at least 1");

    fild::RunRequest request;
    request.command = shell_line(argc, argv);
    request.rawlog = rawlog.getValue();
    request.output = output.getValue();
    if (max_frames.isSet()) request.max_frames = static_cast<std::size_t>(max_frames.getValue());
    request.quiet = quiet.getValue();
    request.truth = truth.options();
    const auto read = [&]
    {
        return config.isSet() ? fild::load_ini_file(config.getValue())
                              : fild::load_ini_text(fild::kDefaultIni, "default.ini");
    };
    request.options = fild::configured<decltype(request.options)>(read, overrides.getValue());
    return request;
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("rawlog-loop-closure", argc, argv, parse, fild::run_loop_closure);
}
