// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/results/csv_columns.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** The stages of a frame that have a column of costs.csv, as StageTimes knows them. */
constexpr std::array<const char*, 13> kFrameStages = {"image_decoding",
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

/** A row of costs.csv: what a frame took. Value type. */
struct CostRow
{
    FrameId frame{};
    /** Wall time, milliseconds, in the order of kFrameStages; 0 for a stage that the frame did not
     *  reach. Stages that run side by side count in full: their sum can be more than whole_frame.
     *  */
    std::array<double, kFrameStages.size()> stage_ms{};
    std::size_t map_bytes = 0;  ///< held for later frames
    std::optional<std::size_t> resident_bytes;  ///< of the process; nothing where it is not known
};

/** `frame`, `<stage>_ms` with 3 decimals, `map_bytes`, `resident_bytes`. */
CsvColumns<CostRow> costs_csv_columns();

/** Of more rows only `max_rows`, at even distances: memory does not grow with the file.
 *  \throw std::runtime_error as read_csv(), for all rows. */
std::vector<CostRow> read_costs_csv(const std::string& path, std::size_t max_rows);

}  // namespace fild
