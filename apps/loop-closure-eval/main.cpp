// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval: a run's folder and ground truth in; precision, recall and wrong loops out.
#include "app_main.h"
#include "evaluation_report.h"
#include "fild/evaluation/frames_csv.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

namespace
{
constexpr std::size_t kMaxWrongLoopsShown = 20;

/** The command line. */
struct AppOptions
{
    std::string run;
    std::string ground_truth;
    fild::Protocol protocol;
    std::string output;  ///< empty: nothing is written
};

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<AppOptions> parse(int argc, char** argv)
{
    using Text = TCLAP::ValueArg<std::string>;
    using Real = TCLAP::ValueArg<double>;
    TCLAP::CmdLine command(
        "Scores the loop closures of a run against ground truth.", ' ', FILD_VERSION);
    const fild::Protocol defaults;
    Text output(
        "o", "output", "Folder for evaluation.json, wrong_loops.csv", false, "", "DIR", command);
    Real age("",
             "min-age",
             "radius:R: a candidate is so much older, seconds (30)",
             false,
             defaults.min_age_seconds,
             "SECONDS",
             command);
    Real angle("",
               "max-angle",
               "radius:R: poses are rotated by at most so much (45)",
               false,
               defaults.max_angle_deg,
               "DEGREES",
               command);
    Text protocol("p",
                  "protocol",
                  "exact (default), window:FRAMES or radius:METRES",
                  false,
                  "exact",
                  "PROTOCOL",
                  command);
    Text truth("g",
               "ground-truth",
               "List of loops, MATLAB loop matrix, TUM or KITTI poses",
               true,
               "",
               "FILE",
               command);
    Text run("r", "run", "Results of rawlog-loop-closure", true, "", "DIR", command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;

    AppOptions options{run.getValue(),
                       truth.getValue(),
                       fild::parse_protocol(protocol.getValue()),
                       output.getValue()};
    if ((angle.isSet() || age.isSet()) && options.protocol.kind != fild::Protocol::Kind::radius)
        throw fild::WrongUsage("--max-angle and --min-age belong to --protocol radius:R");
    if (!(angle.getValue() > 0 && angle.getValue() <= 180))
        throw fild::WrongUsage("--max-angle must be above 0 and at most 180");
    if (!(age.getValue() >= 0 && std::isfinite(age.getValue())))
        throw fild::WrongUsage("--min-age must be at least 0");
    options.protocol.max_angle_deg = angle.getValue();
    options.protocol.min_age_seconds = age.getValue();
    return options;
}

void run(const AppOptions& options)
{
    const auto frames =
        fild::read_frames_csv((std::filesystem::path(options.run) / "frames.csv").string());
    const auto loaded = fild::load_ground_truth(options.ground_truth, frames, options.protocol);
    const fild::EvaluationReport report{options.run,
                                        options.ground_truth,
                                        loaded.content,
                                        loaded.remarks,
                                        options.protocol,
                                        fild::score_loops(frames, *loaded.truth)};
    if (!options.output.empty()) fild::write_report(report, options.output);
    std::cout << fild::to_text(report, kMaxWrongLoopsShown);
}

}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-eval", argc, argv, parse, run);
}
