// SPDX-License-Identifier: BSD-3-Clause
#include "worker.h"

#include "corpus.h"
#include "damage.h"
#include "readers.h"
#include "temporary_folder.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fild::fuzz
{
namespace
{
constexpr long kMaxMegabytes = 1024;
constexpr rlim_t kMaxSeconds = 20;

/** What a process tells the one that started it, also when it crashes. */
struct Progress
{
    std::uint64_t next = 0;  ///< number of the file that it reads now
    std::uint64_t refused = 0;
    long peak_megabytes = 0;
    char finding[4096] = {};  ///< of the file that it read last; empty: none
};

class SharedProgress
{
 public:
    SharedProgress()
        : memory_(::mmap(
              nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    {
        if (memory_ == MAP_FAILED) throw std::runtime_error("no shared memory");
        new (memory_) Progress;
    }
    SharedProgress(const SharedProgress&) = delete;
    SharedProgress& operator=(const SharedProgress&) = delete;
    ~SharedProgress() { ::munmap(memory_, sizeof(Progress)); }

    Progress& operator*() const { return *static_cast<Progress*>(memory_); }
    Progress* operator->() const { return &**this; }

 private:
    void* memory_;
};

/** A file to read. Value type. */
struct Input
{
    std::string reader;
    std::string bytes;
    std::size_t good_entries = 0;
};

Input make_input(const Plan& plan,
                 const std::vector<Sample>& corpus,
                 std::uint64_t number,
                 const std::string& folder)
{
    std::seed_seq seeds{plan.seed, static_cast<std::uint64_t>(plan.kind), number};
    std::mt19937_64 random(seeds);
    const auto& sample = corpus[random() % corpus.size()];
    const bool is_text =
        plan.kind == Kind::ini || plan.kind == Kind::csv || plan.kind == Kind::list;
    // A damaged archive, or an archive of what is damaged.
    if (plan.kind == Kind::rawlog_gz && random() % 2 == 0)
        return {sample.name, damage(packed(sample.bytes, folder), random).bytes, 0};
    auto damaged = is_text ? damage_text(sample.bytes, random) : damage(sample.bytes, random);
    const auto good =
        std::upper_bound(sample.entry_ends.begin(), sample.entry_ends.end(), damaged.first_change);
    Input input{sample.name,
                std::move(damaged.bytes),
                static_cast<std::size_t>(good - sample.entry_ends.begin())};
    if (plan.kind == Kind::rawlog_gz) input.bytes = packed(input.bytes, folder);
    return input;
}

void limit_seconds()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    rlimit limit{};
    getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur =
        static_cast<rlim_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + kMaxSeconds;
    setrlimit(RLIMIT_CPU, &limit);
}

long peak_megabytes()
{
    rusage own{};
    rusage started{};
    getrusage(RUSAGE_SELF, &own);
    getrusage(RUSAGE_CHILDREN, &started);
    return std::max(own.ru_maxrss, started.ru_maxrss) / 1024;
}

void note_finding(Progress& progress, const std::string& finding)
{
    std::strncpy(progress.finding, finding.c_str(), sizeof(progress.finding) - 1);
}

void read_one(const Plan& plan, const Input& input, const std::string& folder, Progress& progress)
{
    const auto path = folder + "/damaged." + plan.name;
    testing::write_text(path, input.bytes);
    limit_seconds();
    try
    {
        read_file(plan.kind, input.reader, path, input.good_entries);
    }
    catch (const Finding& finding)
    {
        note_finding(progress, finding.what());
    }
    catch (const std::exception& error)
    {
        ++progress.refused;
        if (std::strlen(error.what()) == 0) note_finding(progress, "an error without words");
    }
    progress.peak_megabytes = std::max(progress.peak_megabytes, peak_megabytes());
    if (progress.peak_megabytes > kMaxMegabytes)
        note_finding(progress, std::to_string(progress.peak_megabytes) + " MB");
}

/** Reads files until a finding, which ends the process: what was found may have spoilt it. */
[[noreturn]] void read_files(const Plan& plan,
                             const std::vector<Sample>& corpus,
                             const std::string& folder,
                             Progress& progress)
{
    constexpr std::uint64_t kFilesOfAProcess = 200;
    const auto end = std::min(plan.first + plan.count, progress.next + kFilesOfAProcess);
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);  // libpng and others print
    while (progress.next < end && std::chrono::steady_clock::now() < plan.end)
    {
        read_one(plan, make_input(plan, corpus, progress.next, folder), folder, progress);
        if (progress.finding[0] != '\0') break;
        ++progress.next;
    }
    _exit(0);
}

std::string how_it_ended(int status)
{
    if (!WIFSIGNALED(status)) return "";
    if (WTERMSIG(status) == SIGXCPU) return "more than 20 s of computing";
    return "signal " + std::to_string(WTERMSIG(status));
}

void keep(const Plan& plan, const Input& input, std::uint64_t number)
{
    if (plan.findings.empty()) return;
    std::filesystem::create_directories(plan.findings);
    testing::write_text(plan.findings + "/" + std::to_string(plan.seed) + "_" +
                            std::to_string(number) + "." +
                            (input.reader.empty() ? "" : input.reader + ".") + plan.name,
                        input.bytes);
}
}  // namespace

Outcome try_files(const Plan& plan)
{
    const testing::TemporaryFolder folder;
    const auto corpus = make_corpus(plan.kind, folder.path());
    const SharedProgress progress;
    progress->next = plan.first;
    Outcome outcome;
    while (progress->next < plan.first + plan.count && std::chrono::steady_clock::now() < plan.end)
    {
        const auto process = ::fork();
        if (process < 0) throw std::runtime_error("cannot start a process");
        if (process == 0) read_files(plan, corpus, folder.path(), *progress);
        int status = 0;
        ::waitpid(process, &status, 0);
        auto finding = how_it_ended(status);
        if (finding.empty()) finding = progress->finding;
        outcome.peak_megabytes = std::max(outcome.peak_megabytes, progress->peak_megabytes);
        progress->peak_megabytes = 0;
        progress->finding[0] = '\0';
        if (finding.empty()) continue;
        keep(plan, make_input(plan, corpus, progress->next, folder.path()), progress->next);
        outcome.findings.push_back(plan.name + " " + std::to_string(progress->next) + ": " +
                                   finding);
        ++progress->next;
    }
    outcome.tried = progress->next - plan.first;
    outcome.refused = progress->refused;
    return outcome;
}

}  // namespace fild::fuzz
