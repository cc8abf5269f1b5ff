// SPDX-License-Identifier: BSD-3-Clause
#include "eval_options.h"

#include "app_main.h"

#include <cmath>

namespace fild
{
namespace
{
using Text = TCLAP::ValueArg<std::string>;
using Texts = TCLAP::MultiArg<std::string>;
using Real = TCLAP::ValueArg<double>;

/** The arguments, in the order of --help from the last to the first. */
struct Arguments
{
    explicit Arguments(TCLAP::CmdLine& c) : command(c) {}

    TCLAP::CmdLine& command;
    const Protocol defaults{};
    Text output{"o", "output", "Folder for evaluation.json and more", false, "", "DIR", command};
    TCLAP::MultiArg<double> step{
        "", "step", "RPE over steps of so many metres (10 and 100)", false, "METRES", command};
    TCLAP::SwitchArg align_scale{
        "", "align-scale", "Scale trajectories to the truth: they know no metres", command};
    Text true_trajectory{"",
                         "true-trajectory",
                         "True poses for ATE and RPE, when the ground truth is labels",
                         false,
                         "",
                         "FILE",
                         command};
    Texts trajectory{"",
                     "trajectory",
                     "TUM trajectory to be compared, instead of the run's own",
                     false,
                     "FILE",
                     command};
    Real age{"",
             "min-age",
             "radius:R: a candidate is so much older, seconds (30)",
             false,
             defaults.min_age_seconds,
             "SECONDS",
             command};
    Real angle{"",
               "max-angle",
               "radius:R: poses are rotated by at most so much (45)",
               false,
               defaults.max_angle_deg,
               "DEGREES",
               command};
    Text protocol{"p",
                  "protocol",
                  "exact (default), window:FRAMES or radius:METRES",
                  false,
                  "exact",
                  "PROTOCOL",
                  command};
    Text sensor{"",
                "truth-sensor",
                "Of a rawlog: label of the sensor whose poses are the truth",
                false,
                "",
                "LABEL",
                command};
    Text truth{"g",
               "ground-truth",
               "List of loops, MATLAB loop matrix, TUM or KITTI poses, rawlog with poses or GPS",
               true,
               "",
               "FILE",
               command};
    Texts run{"r",
              "run",
              "Results of rawlog-loop-closure; several: of one recording, other seeds",
              true,
              "DIR",
              command};
};

void check(const Arguments& arguments, const EvalOptions& options)
{
    if ((arguments.angle.isSet() || arguments.age.isSet()) &&
        options.protocol.kind != Protocol::Kind::radius)
        throw WrongUsage("--max-angle and --min-age belong to --protocol radius:R");
    const auto& protocol = options.protocol;
    if (!(protocol.max_angle_deg > 0 && protocol.max_angle_deg <= 180))
        throw WrongUsage("--max-angle must be above 0 and at most 180");
    if (!(protocol.min_age_seconds >= 0 && std::isfinite(protocol.min_age_seconds)))
        throw WrongUsage("--min-age must be at least 0");
    for (const double length : options.trajectory_error.step_lengths)
        if (!(length > 0 && std::isfinite(length))) throw WrongUsage("--step must be above 0");
    if (!options.trajectories.empty() && options.runs.size() > 1)
        throw WrongUsage("--trajectory is for one --run");
}
}  // namespace

std::optional<EvalOptions> parse_eval_options(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Scores the loop closures of a run against ground truth.", ' ', FILD_VERSION);
    Arguments arguments(command);
    if (!parse_arguments(command, argc, argv)) return std::nullopt;

    EvalOptions options;
    options.runs = arguments.run.getValue();
    options.ground_truth = arguments.truth.getValue();
    options.truth_sensor = arguments.sensor.getValue();
    options.protocol = parse_protocol(arguments.protocol.getValue());
    options.protocol.max_angle_deg = arguments.angle.getValue();
    options.protocol.min_age_seconds = arguments.age.getValue();
    options.trajectories = arguments.trajectory.getValue();
    options.true_trajectory = arguments.true_trajectory.getValue();
    options.trajectory_error.align_scale = arguments.align_scale.getValue();
    if (arguments.step.isSet()) options.trajectory_error.step_lengths = arguments.step.getValue();
    options.output = arguments.output.getValue();
    check(arguments, options);
    return options;
}

}  // namespace fild
