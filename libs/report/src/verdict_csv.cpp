// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/verdict_csv.h"

#include "csv_table.h"
#include "fild/core/angle.h"

#include <array>
#include <charconv>
#include <ostream>
#include <tuple>

namespace fild
{
namespace
{
/** With 6 decimals; unlike printf() whatever the locale of the program. */
std::string fixed6(double value)
{
    std::array<char, 400> text{};  // the largest double has 309 digits before the point
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 6);
    return {text.data(), end.ptr};
}

constexpr const char* kVerdictColumns =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support,depth_source";

void write_verdict(std::ostream& out, const FrameVerdict& verdict, const std::string& depth_source)
{
    out << to_index(verdict.frame) << ',' << fixed6(verdict.timestamp) << ','
        << csv_field(verdict.sensor_label) << ',' << verdict.keypoints << ',';
    if (verdict.candidate)
        out << to_index(verdict.candidate->frame) << ',' << fixed6(verdict.candidate->similarity);
    else
        out << ',';
    out << ',' << verdict.matches << ',' << verdict.inliers << ',' << (verdict.accepted() ? 1 : 0)
        << ',' << to_word(verdict.rejection) << ',' << fixed6(verdict.support) << ','
        << depth_source;
}

constexpr std::size_t kNumbers = std::tuple_size_v<LoopRow::PoseNumbers>;

void write_numbers(std::ostream& out, const LoopRow::PoseNumbers& numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i)
        out << ',' << fixed6(i < 3 ? numbers[i] : numbers[i] / kRadiansPerDegree);
}

/** Columns of the pose and of its standard deviations. */
void write_pose(std::ostream& out, const LoopRow& loop)
{
    if (loop.candidate_from_query)
    {
        write_numbers(out, *loop.candidate_from_query);
        write_numbers(out, loop.deviations);
    }
    else if (loop.unscaled)
    {
        out << ",,,";
        for (const double angle : loop.unscaled->angles)
            out << ',' << fixed6(angle / kRadiansPerDegree);
        out << std::string(kNumbers, ',');
    }
    else
        out << std::string(2 * kNumbers, ',');
}

void write_direction(std::ostream& out, const LoopRow& loop)
{
    if (!loop.unscaled)
        out << ",,,";
    else
        for (const double each : loop.unscaled->direction) out << ',' << fixed6(each);
}

/** Empty fields where there is no evidence. */
void write_evidence(std::ostream& out, const ConsideredCandidate& entry)
{
    if (!entry.odds)
    {
        out << std::string(kEvidenceKinds + 2, ',');
        return;
    }
    for (const double share : entry.evidence) out << ',' << fixed6(share);
    out << ',' << fixed6(entry.odds->against_chance) << ','
        << fixed6(entry.odds->against_look_alike);
}
}  // namespace

VerdictCsv::VerdictCsv(const std::string& path) : file_(path)
{
    file_.stream() << kVerdictColumns << '\n';
}

void VerdictCsv::add(const FrameVerdict& verdict, const std::string& depth_source)
{
    write_verdict(file_.stream(), verdict, depth_source);
    file_.stream() << '\n' << std::flush;
}

LoopCsv::LoopCsv(const std::string& path) : file_(path)
{
    file_.stream() << kVerdictColumns
                   << ",x,y,z,yaw_deg,pitch_deg,roll_deg,sigma_x,sigma_y,sigma_z,sigma_yaw_deg,"
                      "sigma_pitch_deg,sigma_roll_deg,weight,edge,direction_x,direction_y,"
                      "direction_z\n";
}

void LoopCsv::add(const FrameVerdict& verdict, const std::string& depth_source, const LoopRow& loop)
{
    auto& out = file_.stream();
    write_verdict(out, verdict, depth_source);
    write_pose(out, loop);
    out << ',' << (loop.weight ? fixed6(*loop.weight) : "") << ',' << loop.edge;
    write_direction(out, loop);
    out << '\n';
}

CandidateCsv::CandidateCsv(const std::string& path) : file_(path)
{
    auto& out = file_.stream();
    out << "frame,rank,candidate,similarity,checked,matches,inliers,rejection,support";
    for (std::size_t k = 0; k < kEvidenceKinds; ++k)
        out << ',' << to_word(static_cast<Evidence>(k));
    out << ",against_chance,against_look_alike\n";
}

void CandidateCsv::add(FrameId frame, const std::vector<ConsideredCandidate>& considered)
{
    auto& out = file_.stream();
    for (const auto& entry : considered)
    {
        out << to_index(frame) << ',';
        if (entry.rank > 0) out << entry.rank;
        out << ',' << to_index(entry.candidate.frame) << ',' << fixed6(entry.candidate.similarity)
            << ',' << (entry.checked ? 1 : 0) << ',';
        if (entry.checked)
            out << entry.matches << ',' << entry.inliers << ',' << to_word(entry.rejection) << ','
                << fixed6(entry.support);
        else
            out << ",,,";
        write_evidence(out, entry);
        out << '\n';
    }
}

}  // namespace fild
