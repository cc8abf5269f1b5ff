// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/frames_csv.h"

#include "fild/results/csv_fields.h"
#include "shared_columns.h"

#include <cstdint>
#include <stdexcept>

namespace fild
{
namespace
{
using Column = CsvColumn<FrameRow>;

/** A column that is a number of the verdict. */
Column count_column(const std::string& name, std::size_t FrameVerdict::*member)
{
    return {name,
            [member](const FrameRow& row) { return std::to_string(row.verdict.*member); },
            [member](const CsvField& field, FrameRow& row)
            { row.verdict.*member = field.number<std::size_t>(); }};
}

Column candidate_column()
{
    return {"candidate",
            [](const FrameRow& row)
            {
                const auto& candidate = row.verdict.candidate;
                return candidate ? std::to_string(to_index(candidate->frame)) : "";
            },
            [](const CsvField& field, FrameRow& row)
            {
                if (field.empty()) return;
                if (!row.verdict.candidate) row.verdict.candidate.emplace();
                row.verdict.candidate->frame = FrameId{field.number<std::uint64_t>()};
            }};
}

Column similarity_column()
{
    return {"similarity",
            [](const FrameRow& row)
            {
                const auto& candidate = row.verdict.candidate;
                return candidate ? decimal6(candidate->similarity) : "";
            },
            [](const CsvField& field, FrameRow& row)
            {
                if (field.empty()) return;
                if (!row.verdict.candidate) row.verdict.candidate.emplace();
                row.verdict.candidate->similarity = field.number<double>();
            }};
}

Column rejection_column()
{
    return {"rejection",
            [](const FrameRow& row) { return to_word(row.verdict.rejection); },
            [](const CsvField& field, FrameRow& row)
            { row.verdict.rejection = parse_rejection(field); }};
}

/** Follows from the rejection, which check() compares it with. */
Column accepted_column()
{
    return {"accepted",
            [](const FrameRow& row) { return row.verdict.accepted() ? "1" : "0"; },
            [](const CsvField& field, FrameRow&) { parse_flag(field); }};
}

void check(const FrameVerdict& verdict, std::size_t expected, const CsvReader& reader)
{
    if (to_index(verdict.frame) != expected)
        reader.fail("frame " + std::to_string(to_index(verdict.frame)) + " where frame " +
                    std::to_string(expected) + " is expected");
    if (verdict.accepted() && !verdict.candidate) reader.fail("accepted without a candidate");
    if (verdict.candidate && verdict.candidate->frame >= verdict.frame)
        reader.fail("the candidate is not an earlier frame");
    const auto accepted = reader.field(*reader.position_of("accepted")).text();
    if (accepted != (verdict.accepted() ? "1" : "0"))
        reader.fail("accepted is '" + accepted + "', which the rejection contradicts");
}
}  // namespace

CsvColumns<FrameRow> frames_csv_columns()
{
    return {
        frame_column<FrameRow>([](auto& row) -> auto& { return row.verdict.frame; }),
        {"timestamp",
         [](const FrameRow& row) { return decimal6(row.verdict.timestamp); },
         [](const CsvField& field, FrameRow& row)
         { row.verdict.timestamp = field.number<double>(); }},
        {"sensor_label",
         [](const FrameRow& row) { return csv_field(row.verdict.sensor_label); },
         [](const CsvField& field, FrameRow& row) { row.verdict.sensor_label = field.text(); }},
        count_column("keypoints", &FrameVerdict::keypoints),
        candidate_column(),
        similarity_column(),
        count_column("matches", &FrameVerdict::matches),
        count_column("inliers", &FrameVerdict::inliers),
        accepted_column(),
        rejection_column(),
        {"support",
         [](const FrameRow& row) { return decimal6(row.verdict.support); },
         [](const CsvField& field, FrameRow& row)
         { row.verdict.support = field.number<double>(); }},
        {"depth_source",
         [](const FrameRow& row) { return row.depth_source; },
         [](const CsvField& field, FrameRow& row) { row.depth_source = field.text(); },
         false},
    };
}

std::vector<FrameVerdict> read_frames_csv(const std::string& path)
{
    std::vector<FrameVerdict> verdicts;
    const auto take = [&](FrameRow row, const CsvReader& reader)
    {
        check(row.verdict, verdicts.size(), reader);
        verdicts.push_back(std::move(row.verdict));
    };
    read_csv(path, frames_csv_columns(), take);
    if (verdicts.empty()) throw std::runtime_error(path + " has no frame");
    return verdicts;
}

}  // namespace fild
