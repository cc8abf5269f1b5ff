// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/verdict_csv.h"

#include <array>
#include <cstdio>
#include <ostream>

namespace fild
{
namespace
{
std::string fixed6(double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.6f", value);
    return text.data();
}

/** The text as one CSV field, in quotes where RFC 4180 wants them. */
std::string field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}
}  // namespace

VerdictCsv::VerdictCsv(const std::string& path) : file_(path)
{
    file_.stream() << "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,"
                      "accepted,rejection,support\n";
}

void VerdictCsv::add(const FrameVerdict& verdict)
{
    auto& out = file_.stream();
    out << to_index(verdict.frame) << ',' << fixed6(verdict.timestamp) << ','
        << field(verdict.sensor_label) << ',' << verdict.keypoints << ',';
    if (verdict.candidate)
        out << to_index(verdict.candidate->frame) << ',' << fixed6(verdict.candidate->similarity);
    else
        out << ',';
    out << ',' << verdict.matches << ',' << verdict.inliers << ',' << (verdict.accepted() ? 1 : 0)
        << ',' << to_word(verdict.rejection) << ',' << fixed6(verdict.support) << '\n';
}

CandidateCsv::CandidateCsv(const std::string& path) : file_(path)
{
    file_.stream() << "frame,rank,candidate,similarity,checked,matches,inliers,rejection,support\n";
}

void CandidateCsv::add(FrameId frame, const std::vector<ConsideredCandidate>& considered)
{
    auto& out = file_.stream();
    for (const auto& [candidate, rank, checked, matches, inliers, support, rejection] : considered)
    {
        out << to_index(frame) << ',';
        if (rank > 0) out << rank;
        out << ',' << to_index(candidate.frame) << ',' << fixed6(candidate.similarity) << ','
            << (checked ? 1 : 0) << ',';
        if (checked)
            out << matches << ',' << inliers << ',' << to_word(rejection) << ',' << fixed6(support);
        else
            out << ",,,";
        out << '\n';
    }
}

}  // namespace fild
