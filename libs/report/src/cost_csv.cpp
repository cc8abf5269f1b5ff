// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/cost_csv.h"

#include "fild/report/process_memory.h"

#include <array>
#include <iomanip>

namespace fild
{
namespace
{
constexpr std::array<const char*, 13> kStages = {"image_decoding",
                                                 "global_descriptor",
                                                 "local_features",
                                                 "hashing",
                                                 "depth",
                                                 "index_insertion",
                                                 "index_search",
                                                 "cells",
                                                 "matching",
                                                 "verification",
                                                 "evidence",
                                                 "relative_pose",
                                                 "whole_frame"};
}  // namespace

CostCsv::CostCsv(const std::string& path) : file_(path), totals_ms_(kStages.size())
{
    auto& out = file_.stream();
    out << "frame";
    for (const auto* stage : kStages) out << ',' << stage << "_ms";
    out << ",map_bytes,resident_bytes\n" << std::fixed << std::setprecision(3);
}

void CostCsv::add(FrameId frame, const StageTimes& times, std::size_t map_bytes)
{
    auto& out = file_.stream();
    out << to_index(frame);
    for (std::size_t i = 0; i < kStages.size(); ++i)
    {
        const double total = times.total_ms(kStages[i]);
        out << ',' << total - totals_ms_[i];
        totals_ms_[i] = total;
    }
    out << ',' << map_bytes << ',';
    if (const auto resident = resident_memory_bytes()) out << *resident;
    out << '\n';
}

}  // namespace fild
