// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <string>
#include <vector>

namespace fild
{
/** Reads the verdicts of a run's frames.csv, in the order of frames; labels in quotes (RFC 4180)
 *  may hold commas, but no line ends. The inverse of VerdictCsv, up to the decimals written.
 *  \throw std::runtime_error naming file and line: unreadable, another header, a row that is no
 *         verdict, frames that are not 0, 1, 2..., or a candidate that is not an earlier frame. */
std::vector<FrameVerdict> read_frames_csv(const std::string& path);

}  // namespace fild
