// SPDX-License-Identifier: BSD-3-Clause
// synthetic-rawlog: drives through a synthetic town and writes what the sensors see, and the truth.
#include "app_main.h"
#include "fild/core/ini_file.h"
#include "fild/job/interruption.h"
#include "fild/job/progress_line.h"
#include "fild/synthetic/town_recording.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace
{
using Text = TCLAP::ValueArg<std::string>;
using Number = TCLAP::ValueArg<int>;

/** The command line. */
struct AppOptions
{
    fild::TownRequest request;
    bool quiet = false;
};

/** A flag that was given replaces the key of the configuration that it stands for. */
template <class Value>
void add_flag(std::vector<std::string>& overrides,
              const std::string& key,
              TCLAP::ValueArg<Value>& flag)
{
    std::ostringstream text;
    text << key << "=" << flag.getValue();
    if (flag.isSet()) overrides.push_back(text.str());
}

/** The arguments, in the order of --help from the last to the first. */
struct Arguments
{
    explicit Arguments(TCLAP::CmdLine& c) : command(c) {}

    TCLAP::CmdLine& command;
    std::vector<std::string> sensors{"mono", "stereo", "pair", "rgbd"};
    std::vector<std::string> presets = fild::preset_names();
    TCLAP::ValuesConstraint<std::string> known_sensors{sensors};
    TCLAP::ValuesConstraint<std::string> known_presets{presets};
    TCLAP::SwitchArg quiet{"q", "quiet", "No progress line", command};
    TCLAP::SwitchArg embed{
        "", "embed", "Pixels in the rawlog, not in files in FILE_Images/ beside it", command};
    TCLAP::MultiArg<std::string> overrides{
        "s", "set", "Replaces a value of the configuration", false, "section.key=value", command};
    Text birds_eye{
        "", "birds-eye", "Picture of town and route from the air", false, "", "FILE.png", command};
    Text config{"c", "config", "Changes to the preset", false, "", "FILE.ini", command};
    Number seed{"", "seed", "Another town, route and noise: [town] seed", false, 1, "N", command};
    Number threads{"t",
                   "threads",
                   "Draws with N threads, 0: one for each core; the result is the same",
                   false,
                   0,
                   "N",
                   command};
    Number frames{"n", "frames", "Stop after so many frames", false, 1, "N", command};
    Text sensor{"", "sensor", "What the robot sees with", false, "stereo", &known_sensors, command};
    Text preset{"",
                "preset",
                "Size and difficulty of the drive; --config and --set change it",
                false,
                "demo",
                &known_presets,
                command};
    Text output{"o", "output", "The rawlog; must not exist yet", true, "", "FILE.rawlog", command};
};

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<AppOptions> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Drives through a synthetic town and writes a rawlog with its ground truth.",
        ' ',
        FILD_VERSION);
    Arguments given(command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;
    if (given.frames.getValue() < 1) throw fild::WrongUsage("--frames must be at least 1");
    if (given.threads.getValue() < 0) throw fild::WrongUsage("--threads must not be negative");

    AppOptions options;
    auto& [recording, birds_eye_path, threads] = options.request;
    const auto cores = std::max(1U, std::thread::hardware_concurrency());
    threads =
        given.threads.getValue() > 0 ? static_cast<std::size_t>(given.threads.getValue()) : cores;
    birds_eye_path = given.birds_eye.getValue();
    options.quiet = given.quiet.getValue();
    recording.rawlog_path = given.output.getValue();
    recording.embed = given.embed.getValue();
    recording.options = fild::options_of(fild::preset_named(given.preset.getValue()));
    auto ini = given.config.isSet() ? fild::load_ini_file(given.config.getValue())
                                    : mrpt::config::CConfigFileMemory();
    auto replaced = given.overrides.getValue();
    add_flag(replaced, "sensors.sensor", given.sensor);
    add_flag(replaced, "route.max_frames", given.frames);
    add_flag(replaced, "town.seed", given.seed);
    fild::apply_overrides(ini, replaced);
    fild::load_sections(ini, recording.options.sections());
    return options;
}

void run(const AppOptions& options)
{
    fild::catch_interruption();
    fild::ProgressLine progress(options.quiet, "loops");
    const auto on_frame = [&](std::size_t done, std::size_t frames, std::size_t loops)
    {
        if (fild::interrupted()) throw std::runtime_error("interrupted; nothing was written");
        progress.update(static_cast<double>(done) / static_cast<double>(frames), done, loops);
    };
    const auto made =
        fild::as_usage([&] { return write_town_recording(options.request, on_frame); });
    std::cout << to_text(made) << "\n";
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("synthetic-rawlog", argc, argv, parse, run);
}
