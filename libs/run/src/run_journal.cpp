// SPDX-License-Identifier: BSD-3-Clause
#include "run_journal.h"

#include "fild/core/process_memory.h"

namespace fild
{
RunJournal::RunJournal(const OutputFolder& folder)
    : frames_(folder.file("frames.csv"), frames_csv_columns()),
      candidates_(folder.file("candidates.csv"), candidates_csv_columns()),
      costs_(folder.file("costs.csv"), costs_csv_columns())
{
}

void RunJournal::add_costs(FrameId frame, const LoopClosureStream& stream)
{
    CostRow row{frame, {}, stream.map_bytes(), resident_memory_bytes()};
    for (std::size_t i = 0; i < kFrameStages.size(); ++i)
    {
        const double total_ms = stream.times().total_ms(kFrameStages.at(i));
        row.stage_ms.at(i) = total_ms - stage_totals_ms_.at(i);
        stage_totals_ms_.at(i) = total_ms;
    }
    costs_.add(row);
}

void RunJournal::add(const DetectorOutcome& outcome)
{
    frames_.add({outcome.verdict, to_word(outcome.depth_source)});
    for (const auto& considered : outcome.considered)
        candidates_.add({outcome.verdict.frame, considered});
}

void RunJournal::commit()
{
    frames_.commit();
    candidates_.commit();
    costs_.commit();
}

}  // namespace fild
