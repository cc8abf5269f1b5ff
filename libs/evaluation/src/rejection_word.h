// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "csv_row.h"
#include "fild/core/verdict.h"

#include <cstddef>

namespace fild
{
/** The rejection whose word stands in a column. \throw std::runtime_error when it is none. */
Rejection parse_rejection(const CsvRow& row, std::size_t column);

}  // namespace fild
