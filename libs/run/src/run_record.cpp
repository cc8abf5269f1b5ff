// SPDX-License-Identifier: BSD-3-Clause
#include "run_record.h"

#include "fild/results/loops_csv.h"
#include "map_files.h"

namespace fild
{
namespace
{
/** See FrameVerdict::support. */
double support_threshold(const TDetectorOptions& detector)
{
    return detector.same_place.enabled ? detector.same_place.min_probability : 1;
}
}  // namespace

RunRecord::RunRecord(const OutputFolder& folder, const TRunOptions& options)
    : journal(folder),
      pictures(options.render, options.report, support_threshold(options.stream.detector)),
      folder_(folder)
{
    if (options.report.similarity_frames > 0)
        similarities.emplace(static_cast<std::size_t>(options.report.similarity_frames));
}

void RunRecord::add(const DetectorOutcome& outcome)
{
    const auto& verdict = outcome.verdict;
    journal.add(outcome);
    if (similarities) similarities->add(verdict.frame, outcome.global);
    summary.add(verdict);
    verdicts.push_back(verdict);
    depth_sources.push_back(outcome.depth_source);
    if (verdict.candidate)
        pictures.add(verdict, verdicts.at(to_index(verdict.candidate->frame)).timestamp);
}

void RunRecord::commit()
{
    journal.commit();
    write_loops(nullptr);
    for (const auto source : depth_sources) ++summary.map.depth_sources[to_word(source)];
}

void RunRecord::add_map(const Map& map)
{
    if (!map.frames_with_motion_depth.empty()) write_frames(map);
    write_loops(&map);
    summary.map.depth_sources.clear();
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        ++summary.map.depth_sources[row_of_frame(i, &map).depth_source];
}

FrameRow RunRecord::row_of_frame(std::size_t frame, const Map* map) const
{
    const bool is_motion =
        map != nullptr && map->frames_with_motion_depth.count(verdicts[frame].frame) != 0;
    return {verdicts[frame], to_word(is_motion ? DepthSource::motion : depth_sources[frame])};
}

void RunRecord::write_frames(const Map& map) const
{
    CsvWriter<FrameRow> csv(folder_.file("frames.csv"), frames_csv_columns());
    for (std::size_t i = 0; i < verdicts.size(); ++i) csv.add(row_of_frame(i, &map));
    csv.commit();
}

void RunRecord::write_loops(const Map* map) const
{
    CsvWriter<LoopRow> csv(folder_.file("loops.csv"), loops_csv_columns());
    std::size_t loop = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
    {
        if (!verdicts[i].accepted()) continue;
        auto row = map != nullptr ? row_of(map->loops[loop++]) : LoopRow();
        static_cast<FrameRow&>(row) = row_of_frame(i, map);
        csv.add(row);
    }
    csv.commit();
}

}  // namespace fild
