// SPDX-License-Identifier: BSD-3-Clause
// synthetic-rawlog: drives through a synthetic town and writes what the sensors see, and the truth.
#include "app_main.h"
#include "fild/core/ini_file.h"
#include "fild/core/whole_file.h"
#include "fild/core/words.h"
#include "fild/job/interruption.h"
#include "fild/job/progress_line.h"
#include "fild/synthetic/birds_eye.h"
#include "fild/synthetic/synthetic_recording.h"
#include "fild/synthetic/town.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
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
    fild::SyntheticRequest request;
    std::string birds_eye_path;  ///< empty: no such picture
    std::size_t threads = 1;
    bool quiet = false;
};

fild::Preset preset_named(const std::string& name)
{
    if (name == "tiny") return fild::Preset::tiny;
    if (name == "hard") return fild::Preset::hard;
    return name == "large" ? fild::Preset::large : fild::Preset::demo;
}

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

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<AppOptions> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Drives through a synthetic town and writes a rawlog with its ground truth.",
        ' ',
        FILD_VERSION);
    TCLAP::SwitchArg quiet("q", "quiet", "No progress line", command);
    TCLAP::SwitchArg embed(
        "", "embed", "Pixels in the rawlog, not in files in FILE_Images/ beside it", command);
    TCLAP::MultiArg<std::string> overrides(
        "s", "set", "Replaces a value of the configuration", false, "section.key=value", command);
    Text birds_eye(
        "", "birds-eye", "Picture of town and route from the air", false, "", "FILE.png", command);
    Text config("c", "config", "Changes to the preset", false, "", "FILE.ini", command);
    Number seed("", "seed", "Another town, route and noise: [town] seed", false, 1, "N", command);
    Number threads("t",
                   "threads",
                   "Draws with N threads, 0: one for each core; the result is the same",
                   false,
                   0,
                   "N",
                   command);
    Number frames("n", "frames", "Stop after so many frames", false, 1, "N", command);
    std::vector<std::string> sensors{"mono", "stereo", "pair", "rgbd"};
    TCLAP::ValuesConstraint<std::string> known_sensors(sensors);
    Text sensor("", "sensor", "What the robot sees with", false, "stereo", &known_sensors, command);
    std::vector<std::string> presets{"tiny", "demo", "hard", "large"};
    TCLAP::ValuesConstraint<std::string> known_presets(presets);
    Text preset("",
                "preset",
                "Size and difficulty of the drive; --config and --set change it",
                false,
                "demo",
                &known_presets,
                command);
    Text output("o", "output", "The rawlog; must not exist yet", true, "", "FILE.rawlog", command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;
    if (frames.getValue() < 1) throw fild::WrongUsage("--frames must be at least 1");
    if (threads.getValue() < 0) throw fild::WrongUsage("--threads must not be negative");

    AppOptions options;
    options.threads = threads.getValue() > 0 ? static_cast<std::size_t>(threads.getValue())
                                             : std::max(1U, std::thread::hardware_concurrency());
    options.quiet = quiet.getValue();
    options.birds_eye_path = birds_eye.getValue();
    options.request.rawlog_path = output.getValue();
    options.request.embed = embed.getValue();
    options.request.options = fild::options_of(preset_named(preset.getValue()));
    auto ini =
        config.isSet() ? fild::load_ini_file(config.getValue()) : mrpt::config::CConfigFileMemory();
    auto replaced = overrides.getValue();
    add_flag(replaced, "sensors.sensor", sensor);
    add_flag(replaced, "route.max_frames", frames);
    add_flag(replaced, "town.seed", seed);
    fild::apply_overrides(ini, replaced);
    fild::load_sections(ini, options.request.options.sections());
    return options;
}

void write_birds_eye(fild::WholeFile& file,
                     const fild::TSyntheticOptions& options,
                     fild::Town& town)
{
    const auto seed = static_cast<std::uint64_t>(options.town.seed);
    const auto route = fild::plan_route(options.route, town.grid(), seed);
    std::vector<uchar> png;
    cv::imencode(".png", fild::draw_birds_eye(town, fild::route_lines(route), {}), png);
    file.stream().write(reinterpret_cast<const char*>(png.data()),
                        static_cast<std::streamsize>(png.size()));
    file.commit();
}

void run(const AppOptions& options)
{
    fild::catch_interruption();
    const auto& request = options.request;
    std::optional<fild::WholeFile> birds_eye;  // opened now: a wrong path is told at once
    if (!options.birds_eye_path.empty())
    {
        fild::refuse_existing(options.birds_eye_path);
        fild::remove_unfinished_of(options.birds_eye_path);
        birds_eye.emplace(options.birds_eye_path);
    }
    std::optional<fild::Town> town;  // painted once the request is known to be good
    const auto draw = [&](const auto& camera, const auto& map_from_camera, const auto& conditions)
    {
        if (!town) town.emplace(request.options.town);
        return town->draw(camera, map_from_camera, conditions);
    };
    const auto town_of_a_thread = [&]() -> fild::DrawView
    {
        return [own = std::make_shared<fild::Town>(request.options.town)](
                   const auto& camera, const auto& map_from_camera, const auto& conditions)
        { return own->draw(camera, map_from_camera, conditions); };
    };
    fild::ProgressLine progress(options.quiet, "loops");
    const auto on_frame = [&](std::size_t done, std::size_t frames, std::size_t loops)
    {
        if (fild::interrupted()) throw std::runtime_error("interrupted; nothing was written");
        progress.update(static_cast<double>(done) / static_cast<double>(frames), done, loops);
    };
    const auto made = fild::as_usage(
        [&]
        {
            return write_synthetic_recording(request,
                                             request.options.town.street_grid(),
                                             draw,
                                             on_frame,
                                             {options.threads - 1, town_of_a_thread});
        });
    if (birds_eye) write_birds_eye(*birds_eye, request.options, *town);
    std::cout << made.paths.front() << ": " << fild::count_of(made.frames, "frame") << ", "
              << static_cast<long>(made.metres) << " m, "
              << fild::count_of(made.queries_with_loop, "frame") << " with a loop ("
              << fild::count_of(made.loops, "pair") << "); beside it:";
    for (std::size_t i = 1; i < made.paths.size(); ++i)
        std::cout << (i > 1 ? ", " : " ") << made.paths[i];
    if (birds_eye) std::cout << ", " << options.birds_eye_path;
    std::cout << "\n";
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("synthetic-rawlog", argc, argv, parse, run);
}
