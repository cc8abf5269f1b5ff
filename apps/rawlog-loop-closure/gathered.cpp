// SPDX-License-Identifier: BSD-3-Clause
#include "gathered.h"

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

Gathered::Gathered(const OutputFolder& folder, const TRunOptions& options)
    : frames(folder.file("frames.csv")),
      candidates(folder.file("candidates.csv")),
      costs(folder.file("costs.csv")),
      pictures(options.render, options.report, support_threshold(options.stream.detector)),
      folder_(folder)
{
    if (options.report.similarity_frames > 0)
        similarities.emplace(static_cast<std::size_t>(options.report.similarity_frames));
}

void Gathered::add_costs(FrameId frame, const LoopClosureStream& stream)
{
    costs.add(frame, stream.times(), stream.map_bytes());
}

void Gathered::add(const DetectorOutcome& outcome)
{
    const auto& verdict = outcome.verdict;
    frames.add(verdict, to_word(outcome.depth_source));
    candidates.add(verdict.frame, outcome.considered);
    if (similarities) similarities->add(verdict.frame, outcome.global);
    summary.add(verdict);
    verdicts.push_back(verdict);
    depth_sources.push_back(outcome.depth_source);
    if (verdict.candidate)
        pictures.add(verdict, verdicts.at(to_index(verdict.candidate->frame)).timestamp);
}

void Gathered::commit_verdicts()
{
    frames.commit();
    candidates.commit();
    costs.commit();
    write_loops(nullptr);
    for (const auto source : depth_sources) ++summary.map.depth_sources[to_word(source)];
}

void Gathered::add_map(const Map& map)
{
    if (!map.frames_with_motion_depth.empty()) write_frames(map);
    write_loops(&map);
    summary.map.depth_sources.clear();
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        ++summary.map.depth_sources[source_word(i, &map)];
}

std::string Gathered::source_word(std::size_t frame, const Map* map) const
{
    const bool is_motion =
        map != nullptr && map->frames_with_motion_depth.count(verdicts[frame].frame) != 0;
    return to_word(is_motion ? DepthSource::motion : depth_sources[frame]);
}

void Gathered::write_frames(const Map& map) const
{
    VerdictCsv csv(folder_.file("frames.csv"));
    for (std::size_t i = 0; i < verdicts.size(); ++i) csv.add(verdicts[i], source_word(i, &map));
    csv.commit();
}

void Gathered::write_loops(const Map* map) const
{
    LoopCsv csv(folder_.file("loops.csv"));
    std::size_t loop = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        if (verdicts[i].accepted())
            csv.add(verdicts[i],
                    source_word(i, map),
                    map != nullptr ? row_of(map->loops[loop++]) : LoopRow());
    csv.commit();
}

}  // namespace fild
