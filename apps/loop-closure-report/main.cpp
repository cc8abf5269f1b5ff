// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-report: makes report.html anew out of the results of a run.
#include "app_main.h"
#include "fild/report/html_report.h"
#include "truth.h"

#include <optional>
#include <string>

namespace
{
using Text = TCLAP::ValueArg<std::string>;

struct ReportRequest
{
    std::string run;  ///< folder
    fild::TReportOptions options;
    std::optional<fild::TruthOptions> truth;
};

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<ReportRequest> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Makes report.html anew out of the results of a run.", ' ', FILD_VERSION);
    const ReportRequest defaults;
    TCLAP::ValueArg<int> width("",
                               "picture-width",
                               "Wider pictures are scaled down (800)",
                               false,
                               defaults.options.picture_width_px,
                               "PIXELS",
                               command);
    TCLAP::ValueArg<int> pictures("",
                                  "max-pictures",
                                  "Pictures of pairs in the report (150)",
                                  false,
                                  defaults.options.max_pictures,
                                  "COUNT",
                                  command);
    Text protocol("p",
                  "protocol",
                  "exact (default), window:FRAMES or radius:METRES",
                  false,
                  "exact",
                  "PROTOCOL",
                  command);
    Text sensor("",
                "truth-sensor",
                "Of a rawlog: label of the sensor whose poses are the truth",
                false,
                "",
                "LABEL",
                command);
    Text truth(
        "g",
        "ground-truth",
        "As for loop-closure-eval: precision, recall and trajectory errors go into the report",
        false,
        "",
        "FILE",
        command);
    Text run("r", "run", "Output folder of rawlog-loop-closure", true, "", "DIR", command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;
    if (!truth.isSet() && (protocol.isSet() || sensor.isSet()))
        throw fild::WrongUsage("--protocol and --truth-sensor belong to --ground-truth");

    ReportRequest request;
    request.run = run.getValue();
    request.options.max_pictures = pictures.getValue();
    request.options.picture_width_px = width.getValue();
    request.options.check();
    if (truth.isSet())
        request.truth = fild::TruthOptions{
            truth.getValue(), sensor.getValue(), fild::parse_protocol(protocol.getValue())};
    return request;
}

fild::ReportTruth judge(const std::string& folder, const fild::TruthOptions& options)
{
    const auto run = fild::read_run(folder);
    const auto truth = fild::load_truth(options, run.frames);
    fild::ReportTruth judged;
    judged.description = {options.file, truth.content, truth.remarks, options.protocol};
    judged.evaluation = fild::evaluate_loops(run, *truth.truth);
    if (!truth.poses) return judged;
    judged.evaluation.trajectories = fild::evaluate_trajectories(run, *truth.poses, {});
    judged.poses = truth.poses->frames;
    return judged;
}

void make_report(const ReportRequest& request)
{
    std::optional<fild::ReportTruth> truth;
    if (request.truth) truth = judge(request.run, *request.truth);
    fild::write_html_report(request.run, request.options, truth);
    std::cout << request.run << "/report.html\n";
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-report", argc, argv, parse, make_report);
}
