// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/frames_csv.h"

#include "csv_row.h"
#include "rejection_word.h"

#include <cstdint>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr const char* kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection,support";

FrameVerdict parse_verdict(const CsvRow& row)
{
    FrameVerdict verdict;
    verdict.frame = FrameId{row.number<std::uint64_t>(0)};
    verdict.timestamp = row.number<double>(1);
    verdict.sensor_label = row.text(2);
    verdict.keypoints = row.number<std::size_t>(3);
    if (!row.text(4).empty())
        verdict.candidate = Candidate{FrameId{row.number<std::uint64_t>(4)}, row.number<double>(5)};
    verdict.matches = row.number<std::size_t>(6);
    verdict.inliers = row.number<std::size_t>(7);
    verdict.rejection = parse_rejection(row, 9);
    verdict.support = row.number<double>(10);
    if (row.text(8) != (verdict.accepted() ? "1" : "0"))
        row.fail("accepted is '" + row.text(8) + "', which the rejection contradicts");
    if (verdict.accepted() && !verdict.candidate) row.fail("accepted without a candidate");
    if (verdict.candidate && verdict.candidate->frame >= verdict.frame)
        row.fail("the candidate is not an earlier frame");
    return verdict;
}
}  // namespace

std::vector<FrameVerdict> read_frames_csv(const std::string& path)
{
    std::vector<FrameVerdict> verdicts;
    const auto take = [&](const CsvRow& row)
    {
        verdicts.push_back(parse_verdict(row));
        if (to_index(verdicts.back().frame) != verdicts.size() - 1)
            row.fail("frame " + row.text(0) + " where frame " +
                     std::to_string(verdicts.size() - 1) + " is expected");
    };
    for_each_csv_row(path, kHeader, take);
    if (verdicts.empty()) throw std::runtime_error(path + " has no frame");
    return verdicts;
}

}  // namespace fild
