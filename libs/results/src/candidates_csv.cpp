// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/candidates_csv.h"

#include "shared_columns.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace fild
{
namespace
{
using Columns = CsvColumns<CandidateRow>;

/** Of what is written only for a checked candidate. */
template <class Text, class Parse>
CsvColumn<CandidateRow> checked_column(const std::string& name, Text text, Parse parse)
{
    return {name,
            [text](const CandidateRow& row)
            { return row.considered.checked ? text(row.considered) : ""; },
            [parse](const CsvField& field, CandidateRow& row)
            {
                if (!field.empty()) parse(field, row.considered);
            }};
}

void append_identity(Columns& columns)
{
    columns.push_back(frame_column<CandidateRow>([](auto& row) -> auto& { return row.frame; }));
    columns.push_back({"rank",
                       [](const CandidateRow& row) {
                           return row.considered.rank > 0 ? std::to_string(row.considered.rank)
                                                          : "";
                       },
                       [](const CsvField& field, CandidateRow& row)
                       { row.considered.rank = field.number_or_zero<std::size_t>(); }});
    columns.push_back({"candidate",
                       [](const CandidateRow& row)
                       { return std::to_string(to_index(row.considered.candidate.frame)); },
                       [](const CsvField& field, CandidateRow& row) {
                           row.considered.candidate.frame = FrameId{field.number<std::uint64_t>()};
                       }});
    columns.push_back({"similarity",
                       [](const CandidateRow& row)
                       { return decimal6(row.considered.candidate.similarity); },
                       [](const CsvField& field, CandidateRow& row)
                       { row.considered.candidate.similarity = field.number<double>(); }});
    columns.push_back({"checked",
                       [](const CandidateRow& row) { return row.considered.checked ? "1" : "0"; },
                       [](const CsvField& field, CandidateRow& row)
                       { row.considered.checked = parse_flag(field); }});
}

void append_verification(Columns& columns)
{
    using Entry = ConsideredCandidate;
    columns.push_back(checked_column(
        "matches",
        [](const Entry& entry) { return std::to_string(entry.matches); },
        [](const CsvField& field, Entry& entry) { entry.matches = field.number<std::size_t>(); }));
    columns.push_back(checked_column(
        "inliers",
        [](const Entry& entry) { return std::to_string(entry.inliers); },
        [](const CsvField& field, Entry& entry) { entry.inliers = field.number<std::size_t>(); }));
    columns.push_back(checked_column(
        "rejection",
        [](const Entry& entry) { return to_word(entry.rejection); },
        [](const CsvField& field, Entry& entry) { entry.rejection = parse_rejection(field); }));
    columns.push_back(checked_column(
        "support",
        [](const Entry& entry) { return decimal6(entry.support); },
        [](const CsvField& field, Entry& entry) { entry.support = field.number<double>(); }));
}

void append_evidence(Columns& columns)
{
    for (std::size_t k = 0; k < kEvidenceKinds; ++k)
        columns.push_back({to_word(static_cast<Evidence>(k)),
                           [k](const CandidateRow& row)
                           {
                               const auto& entry = row.considered;
                               return entry.odds ? decimal6(entry.evidence.at(k)) : "";
                           },
                           [k](const CsvField& field, CandidateRow& row)
                           { row.considered.evidence.at(k) = field.number_or_zero<double>(); },
                           false});
    const std::pair<const char*, double PairOdds::*> odds[] = {
        {"against_chance", &PairOdds::against_chance},
        {"against_look_alike", &PairOdds::against_look_alike}};
    for (const auto& [name, member] : odds)
        columns.push_back({name,
                           [member = member](const CandidateRow& row)
                           {
                               const auto& known = row.considered.odds;
                               return known ? decimal6((*known).*member) : "";
                           },
                           [member = member](const CsvField& field, CandidateRow& row)
                           {
                               if (field.empty()) return;
                               auto& known = row.considered.odds;
                               if (!known) known.emplace();
                               (*known).*member = field.number<double>();
                           },
                           false});
}

void check(const CandidateRow& row, std::size_t frames, const CsvReader& reader)
{
    require_frame(row.frame, frames, reader);
    const auto& entry = row.considered;
    if (entry.candidate.frame >= row.frame) reader.fail("the candidate is not an earlier frame");
    if (entry.rank == 0 && !entry.checked)
        reader.fail("neither an answer of the index nor checked");
}
}  // namespace

CsvColumns<CandidateRow> candidates_csv_columns()
{
    Columns columns;
    append_identity(columns);
    append_verification(columns);
    append_evidence(columns);
    return columns;
}

AnswersOfFrames read_candidates_csv(const std::string& path, std::size_t frames)
{
    AnswersOfFrames answers(frames);
    std::vector<std::size_t> last_ranks(frames);
    const auto take = [&](const CandidateRow& row, const CsvReader& reader)
    {
        check(row, frames, reader);
        const auto rank = row.considered.rank;
        auto& last_rank = last_ranks[to_index(row.frame)];
        if (rank > 0 && rank <= last_rank)
            reader.fail("rank " + std::to_string(rank) + " comes after rank " +
                        std::to_string(last_rank));
        last_rank = std::max(last_rank, rank);
        answers[to_index(row.frame)].push_back(row.considered);
    };
    read_csv(path, candidates_csv_columns(), take);
    return answers;
}

}  // namespace fild
