// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/candidates_csv.h"

#include "csv_row.h"
#include "fild/core/words.h"
#include "rejection_word.h"

#include <algorithm>
#include <cstdint>

namespace fild
{
namespace
{
constexpr const char* kHeader =
    "frame,rank,candidate,similarity,checked,matches,inliers,rejection,support";

ConsideredCandidate parse_answer(const CsvRow& row, std::uint64_t frame)
{
    ConsideredCandidate answer;
    answer.rank = row.number_or_zero<std::size_t>(1);
    answer.candidate = {FrameId{row.number<std::uint64_t>(2)}, row.number<double>(3)};
    if (to_index(answer.candidate.frame) >= frame)
        row.fail("the candidate is not an earlier frame");
    if (row.text(4) != "0" && row.text(4) != "1")
        row.fail("checked is '" + row.text(4) + "', it must be 0 or 1");
    answer.checked = row.text(4) == "1";
    if (answer.rank == 0 && !answer.checked) row.fail("neither an answer of the index nor checked");
    answer.matches = row.number_or_zero<std::size_t>(5);
    answer.inliers = row.number_or_zero<std::size_t>(6);
    answer.rejection = parse_rejection(row, 7);
    answer.support = row.number_or_zero<double>(8);
    return answer;
}
}  // namespace

AnswersOfFrames read_candidates_csv(const std::string& path, std::size_t frames)
{
    AnswersOfFrames answers(frames);
    std::vector<std::size_t> last_ranks(frames);
    const auto take = [&](const CsvRow& row)
    {
        const auto frame = row.number<std::uint64_t>(0);
        if (frame >= frames)
            row.fail("frame " + row.text(0) + ", the run has " + count_of(frames, "frame") +
                     " from 0");
        const auto answer = parse_answer(row, frame);
        auto& last_rank = last_ranks[frame];
        if (answer.rank > 0 && answer.rank <= last_rank)
            row.fail("rank " + row.text(1) + " comes after rank " + std::to_string(last_rank));
        last_rank = std::max(last_rank, answer.rank);
        answers[frame].push_back(answer);
    };
    for_each_csv_row(path, kHeader, take);
    return answers;
}

}  // namespace fild
