// SPDX-License-Identifier: BSD-3-Clause
// Damages files of every kind that users hand to the apps, and reads them.
#include "worker.h"

#include <mrpt/3rdparty/tclap/CmdLine.h>
#include <opencv2/core/utility.hpp>

#include <exception>
#include <iostream>

namespace
{
using fild::fuzz::Plan;

/** What was typed. Value type. */
struct Request
{
    std::string kind;
    std::uint64_t seed = 1;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    int seconds = 0;
    std::string findings;
};

Request parse(int argc, char** argv)
{
    TCLAP::CmdLine command(
        "Damages files of every kind and reads them; exit 1 when one crashes the "
        "reader, takes over 20 s or 1 GB, or what is good is lost.");
    TCLAP::ValueArg<std::string> kind("", "kind", "only this kind", false, "", "KIND", command);
    TCLAP::ValueArg<unsigned> seed("", "seed", "of the damage", false, 1, "N", command);
    TCLAP::ValueArg<unsigned> first(
        "", "first", "number of the first file of a kind", false, 0, "N", command);
    TCLAP::ValueArg<unsigned> count(
        "", "count", "files of each kind at most", false, 1000000000, "N", command);
    TCLAP::ValueArg<int> seconds("", "seconds", "for all kinds together", false, 60, "S", command);
    TCLAP::ValueArg<std::string> findings(
        "", "findings", "folder for files that show a fault", false, "", "DIR", command);
    command.parse(argc, argv);
    return {kind.getValue(),
            seed.getValue(),
            first.getValue(),
            count.getValue(),
            seconds.getValue(),
            findings.getValue()};
}

/** \return how many faults were found. */
std::size_t run(const Request& request)
{
    std::size_t findings = 0;
    std::size_t kinds_left = request.kind.empty() ? fild::fuzz::kKinds.size() : 1;
    const auto start = std::chrono::steady_clock::now();
    const auto end = start + std::chrono::seconds(request.seconds);
    for (const auto& [kind, name] : fild::fuzz::kKinds)
    {
        if (!request.kind.empty() && request.kind != name) continue;
        const auto now = std::chrono::steady_clock::now();
        const auto share = (end - now) / static_cast<long>(kinds_left--);
        const auto outcome = fild::fuzz::try_files(Plan{
            kind, name, request.seed, request.first, request.count, now + share, request.findings});
        std::cout << name << ": " << outcome.tried << " files, " << outcome.refused
                  << " refused, at most " << outcome.peak_megabytes << " MB, "
                  << outcome.findings.size() << " faults\n";
        for (const auto& finding : outcome.findings) std::cout << "  " << finding << "\n";
        std::cout.flush();
        findings += outcome.findings.size();
        if (outcome.tried == 0) throw std::runtime_error("no time for " + std::string(name));
    }
    return findings;
}
}  // namespace

int main(int argc, char** argv)
{
    try
    {
        cv::setNumThreads(1);  // processes are forked
        return run(parse(argc, argv)) == 0 ? 0 : 1;
    }
    catch (const std::exception& error)
    {
        std::cerr << "fild_fuzz: " << error.what() << "\n";
        return 2;
    }
}
