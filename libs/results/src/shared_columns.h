// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/number_text.h"
#include "fild/core/verdict.h"
#include "fild/results/csv_columns.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace fild
{
/** As most numbers of a run are written. */
inline std::string decimal6(double number)
{
    return decimal(number, 6);
}

/** The column `frame`. \param frame_of  gives the FrameId of a row, by reference. */
template <class Row, class FrameOf>
CsvColumn<Row> frame_column(const FrameOf& frame_of)
{
    return {"frame",
            [=](const Row& row) { return std::to_string(to_index(frame_of(row))); },
            [=](const CsvField& field, Row& row)
            { frame_of(row) = FrameId{field.number<std::uint64_t>()}; }};
}

/** The inverse of to_word(Rejection). \throw std::runtime_error naming file, line and column. */
Rejection parse_rejection(const CsvField& field);

/** True for 1, false for 0. \throw std::runtime_error naming file, line and column. */
bool parse_flag(const CsvField& field);

/** \throw std::runtime_error naming file and line unless the run has the frame.
 *  \param frames  of the run. */
void require_frame(FrameId frame, std::size_t frames, const CsvReader& reader);

}  // namespace fild
