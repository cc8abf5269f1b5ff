// SPDX-License-Identifier: BSD-3-Clause
#include "gathered.h"

#include "map_files.h"

namespace fild
{
Gathered::Gathered(const OutputFolder& folder, const TRunOptions& options)
    : frames(folder.file("frames.csv")),
      loops(folder.file("loops.csv")),
      candidates(folder.file("candidates.csv")),
      costs(folder.file("costs.csv")),
      pictures(options.render, options.report)
{
    if (options.report.similarity_frames > 0)
        similarities.emplace(static_cast<std::size_t>(options.report.similarity_frames));
}

void Gathered::add(const DetectorOutcome& outcome, const LoopClosureStream& stream)
{
    const auto& verdict = outcome.verdict;
    candidates.add(verdict.frame, outcome.considered);
    costs.add(verdict.frame, stream.times(), stream.detector().map_bytes());
    if (similarities) similarities->add(verdict.frame, outcome.global);
    summary.add(verdict);
    verdicts.push_back(verdict);
    depth_sources.push_back(outcome.depth_source);
    if (verdict.candidate)
        pictures.add(outcome, verdicts.at(to_index(verdict.candidate->frame)).timestamp);
}

void Gathered::write_rows(const std::optional<Map>& map)
{
    std::size_t loop = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
    {
        const auto& verdict = verdicts[i];
        const bool has_motion_depth =
            map && map->frames_with_motion_depth.count(verdict.frame) != 0;
        const auto source = to_word(has_motion_depth ? DepthSource::motion : depth_sources[i]);
        frames.add(verdict, source);
        ++summary.map.depth_sources[source];
        if (verdict.accepted())
            loops.add(verdict, source, map ? row_of(map->loops[loop++]) : LoopRow());
    }
    frames.commit();
    loops.commit();
}

}  // namespace fild
