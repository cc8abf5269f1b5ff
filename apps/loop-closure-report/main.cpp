// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-report: makes report.html anew out of the results of a run, or compares two runs.
#include "app_main.h"
#include "fild/run/judged_run.h"
#include "truth_arguments.h"

#include <optional>
#include <string>
#include <vector>

namespace
{
using Text = TCLAP::ValueArg<std::string>;

struct ReportRequest
{
    std::vector<std::string> runs;  ///< folders; two are compared
    std::string output;  ///< of a comparison
    fild::TReportOptions options;
    std::optional<fild::TruthOptions> truth;
    bool quiet = false;
};

/** The arguments, in the order of --help from the last to the first. */
struct Arguments
{
    explicit Arguments(TCLAP::CmdLine& c) : command(c) {}

    TCLAP::CmdLine& command;
    const fild::TReportOptions defaults{};
    TCLAP::SwitchArg quiet{"q", "quiet", "Print nothing unless something fails", command};
    TCLAP::ValueArg<int> width{"",
                               "picture-width",
                               "Wider pictures are scaled down (700)",
                               false,
                               defaults.picture_width_px,
                               "PIXELS",
                               command};
    TCLAP::ValueArg<int> pictures{"",
                                  "max-pictures",
                                  "Pictures of pairs in the page (150)",
                                  false,
                                  defaults.max_pictures,
                                  "COUNT",
                                  command};
    fild::TruthArguments truth{command, false};
    Text output{"o",
                "output",
                "With --compare: the page to write (comparison.html)",
                false,
                "comparison.html",
                "FILE",
                command};
    TCLAP::SwitchArg compare{
        "c", "compare", "Compares two output folders of rawlog-loop-closure: DIR DIR", command};
    TCLAP::UnlabeledMultiArg<std::string> compared{
        "compared", "The two folders of --compare", false, "DIR", command};
    Text run{"r", "run", "Output folder of rawlog-loop-closure", false, "", "DIR", command};

    /** \throw fild::WrongUsage */
    void require_sense()
    {
        if (run.isSet() == compare.isSet())
            throw fild::WrongUsage("give either --run DIR or --compare DIR1 DIR2");
        if (compared.getValue().size() != (compare.isSet() ? 2U : 0U))
            throw fild::WrongUsage("two folders belong to --compare, none to --run");
        if (output.isSet() && !compare.isSet())
            throw fild::WrongUsage("--output belongs to --compare; --run writes DIR/report.html");
    }
};

/** Nothing when --help or --version was all that was asked for. \throw fild::WrongUsage */
std::optional<ReportRequest> parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Makes report.html anew out of the results of a run, or a page that compares two runs.",
        ' ',
        FILD_VERSION);
    Arguments given(command);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;
    given.require_sense();

    ReportRequest request;
    request.runs = given.compared.getValue();
    if (given.run.isSet()) request.runs = {given.run.getValue()};
    request.output = given.output.getValue();
    request.options.max_pictures = given.pictures.getValue();
    request.options.picture_width_px = given.width.getValue();
    request.options.check();
    request.truth = given.truth.options();
    request.quiet = given.quiet.getValue();
    return request;
}

void make_report(const ReportRequest& request)
{
    const auto judged = [&](std::size_t i)
    {
        fild::ComparedRun run{request.runs[i], std::nullopt};
        if (request.truth) run.truth = fild::judge_run(run.folder, *request.truth);
        return run;
    };
    if (request.runs.size() == 2)
    {
        fild::write_html_comparison(judged(0), judged(1), request.options, request.output);
        if (!request.quiet) std::cout << request.output << "\n";
        return;
    }
    const auto [folder, truth] = judged(0);
    fild::write_html_report(folder, request.options, truth);
    if (!request.quiet) std::cout << folder << "/report.html\n";
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-report", argc, argv, parse, make_report);
}
