// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-graphslam: MRPT's graph-SLAM engine with visual loop closures, without a window.
#include "app_main.h"
#include "fild/graphslam/engine_run.h"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace
{
using Text = TCLAP::ValueArg<std::string>;

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<fild::EngineRequest> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Runs MRPT's graph-SLAM engine over a rawlog with odometry and stereo or depth images, "
        "with "
        "visual loop closures as edges, without a window.",
        ' ',
        FILD_VERSION);
    TCLAP::SwitchArg quiet("q", "quiet", "No progress line", command);
    TCLAP::SwitchArg no_loops("", "no-loops", "Odometry alone, to compare with", command);
    std::vector<std::string> words = {"2d", "3d"};
    TCLAP::ValuesConstraint<std::string> either(words);
    Text dimensions(
        "d", "dimensions", "Of the graph; 3d if not given", false, "3d", &either, command);
    Text output("o", "output", "Folder for the results; made if need be", true, "", "DIR", command);
    Text config("c",
                "config",
                "The engine's configuration; see config-ini/graphslam_engine.ini",
                true,
                "",
                "FILE.ini",
                command);
    Text rawlog("r", "rawlog", "The recording, plain or gzipped", true, "", "FILE.rawlog", command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;

    fild::EngineRequest request;
    request.rawlog = rawlog.getValue();
    request.config = config.getValue();
    request.output = output.getValue();
    if (dimensions.getValue() == "2d") request.dimensions = fild::GraphDimensions::planar;
    request.with_loops = !no_loops.getValue();
    request.quiet = quiet.getValue();
    return request;
}

void run(const fild::EngineRequest& request)
{
    const auto result = fild::run_engine(request);
    std::cout << result.nodes << " nodes, " << result.odometry_edges << " odometry edges, "
              << result.loop_edges << " loop edges, in " << request.output << "\n";
    for (const auto& [reason, count] : result.withheld)
        std::cout << "  loop closures without an edge, " << reason << ": " << count << "\n";
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-graphslam", argc, argv, parse, run);
}
