// SPDX-License-Identifier: BSD-3-Clause
#include "eval_options.h"

#include "truth_arguments.h"

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
    Text output{"o", "output", "Folder for the files of results", false, "", "DIR", command};
    TCLAP::SwitchArg quiet{"q", "quiet", "No progress line", command};
    TCLAP::ValueArg<int> jobs{"j",
                              "jobs",
                              "--rawlog: so many runs at a time (as many as there are cores)",
                              false,
                              0,
                              "RUNS",
                              command};
    TCLAP::ValueArg<int> max_frames{"n",
                                    "max-frames",
                                    "--rawlog: stop after so many camera frames",
                                    false,
                                    1,
                                    "FRAMES",
                                    command};
    Text seeds{"",
               "seeds",
               "--rawlog: one run with each seed, such as 1-10 or 1,2,7",
               false,
               "",
               "SEEDS",
               command};
    Texts swept{"",
                "sweep",
                "--rawlog: one run with each value; several: with all combinations",
                false,
                "section.key=a,b,c",
                command};
    Texts changes{"",
                  "change",
                  "--rawlog: one run with these values beside one without; several: each alone",
                  false,
                  "section.key=value ...",
                  command};
    Texts overrides{"s",
                    "set",
                    "--rawlog: replaces a value of the configuration",
                    false,
                    "section.key=value",
                    command};
    Text config{
        "c", "config", "--rawlog: configuration of the runs", false, "", "FILE.ini", command};
    Text rawlog{"",
                "rawlog",
                "Instead of --run: a recording to run the detector on, as --sweep and --seeds say",
                false,
                "",
                "FILE.rawlog",
                command};
    TCLAP::MultiArg<double> step{
        "", "step", "RPE over steps of so many metres (10 and 100)", false, "METRES", command};
    TCLAP::SwitchArg align_scale{
        "", "align-scale", "Scale trajectories to the truth: they know no metres", command};
    Texts trajectory{"",
                     "trajectory",
                     "TUM trajectory to be compared, instead of the run's own",
                     false,
                     "FILE",
                     command};
    Real age{"",
             "min-age",
             "radius:R: least age of a candidate, seconds (the delay of the run; 30 if unknown)",
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
    TruthArguments truth{command, true};
    Texts run{"r",
              "run",
              "Results of rawlog-loop-closure; several: of one recording, other seeds",
              false,
              "DIR",
              command};
};

void check_protocol(const Arguments& arguments, const Protocol& protocol)
{
    if ((arguments.angle.isSet() || arguments.age.isSet()) &&
        protocol.kind != Protocol::Kind::radius)
        throw WrongUsage("--max-angle and --min-age belong to --protocol radius:R");
    if (!(protocol.max_angle_deg > 0 && protocol.max_angle_deg <= 180))
        throw WrongUsage("--max-angle must be above 0 and at most 180");
    if (!(protocol.min_age_seconds >= 0 && std::isfinite(protocol.min_age_seconds)))
        throw WrongUsage("--min-age must be at least 0");
}

/** The arguments that make no sense together with the one that chooses what is scored. */
template <class... Argument>
void refuse_beside(const std::string& choice, const Argument&... arguments)
{
    const auto refuse = [&](const TCLAP::Arg& argument)
    {
        if (argument.isSet())
            throw WrongUsage("--" + argument.getName() + " does not go with --" + choice);
    };
    (refuse(arguments), ...);
}

void check(const Arguments& a, const EvaluationRequest& options)
{
    if (a.run.isSet() == a.rawlog.isSet()) throw WrongUsage("give either --run or --rawlog");
    if (a.run.isSet())
        refuse_beside(
            "run", a.config, a.overrides, a.swept, a.changes, a.seeds, a.max_frames, a.jobs);
    else
        refuse_beside("rawlog", a.trajectory, a.truth.trajectory, a.align_scale, a.step);
    if (a.swept.isSet()) refuse_beside("sweep", a.changes);
    if (a.rawlog.isSet() && !a.config.isSet()) throw WrongUsage("--rawlog needs --config");
    check_protocol(a, options.truth.protocol);
    for (const double length : options.trajectory_error.step_lengths)
        if (!(length > 0 && std::isfinite(length))) throw WrongUsage("--step must be above 0");
    if (!options.trajectories.empty() && options.runs.size() > 1)
        throw WrongUsage("--trajectory is for one --run");
    if (a.truth.sensor.isSet() && !is_rawlog(options.truth.file) &&
        !is_rawlog(options.truth.trajectory))
        throw WrongUsage("--truth-sensor is for a rawlog as ground truth");
}

SweepRequest sweep_request_of(Arguments& arguments, const TruthOptions& truth)
{
    if (arguments.max_frames.getValue() < 1) throw WrongUsage("--max-frames must be at least 1");
    if (arguments.jobs.getValue() < 0) throw WrongUsage("--jobs must be at least 0");
    SweepRequest request;
    request.rawlog = arguments.rawlog.getValue();
    request.config = arguments.config.getValue();
    request.overrides = arguments.overrides.getValue();
    for (const auto& words : arguments.swept.getValue())
        request.keys.push_back(parse_swept_key(words));
    request.changes = arguments.changes.getValue();
    if (arguments.seeds.isSet()) request.seeds = parse_seeds(arguments.seeds.getValue());
    if (arguments.max_frames.isSet())
        request.max_frames = static_cast<std::size_t>(arguments.max_frames.getValue());
    request.jobs = arguments.jobs.getValue();
    request.quiet = arguments.quiet.getValue();
    request.truth = truth;
    return request;
}
}  // namespace

std::optional<EvalOptions> parse_eval_options(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Scores loop closures against ground truth: those of runs, or of the detector on a "
        "recording with several values and seeds.",
        ' ',
        FILD_VERSION);
    Arguments arguments(command);
    if (!parse_arguments(command, argc, argv)) return std::nullopt;

    EvalOptions options;
    auto& evaluation = options.evaluation;
    evaluation.runs = arguments.run.getValue();
    evaluation.truth = *arguments.truth.options();
    evaluation.truth.protocol.max_angle_deg = arguments.angle.getValue();
    evaluation.truth.protocol.min_age_seconds = arguments.age.getValue();
    evaluation.truth.min_age_is_given = arguments.age.isSet();
    evaluation.trajectories = arguments.trajectory.getValue();
    auto& error = evaluation.trajectory_error;
    error.align_scale = arguments.align_scale.getValue();
    if (arguments.step.isSet()) error.step_lengths = arguments.step.getValue();
    options.output = arguments.output.getValue();
    check(arguments, evaluation);
    if (arguments.rawlog.isSet()) options.sweep = sweep_request_of(arguments, evaluation.truth);
    return options;
}

}  // namespace fild
