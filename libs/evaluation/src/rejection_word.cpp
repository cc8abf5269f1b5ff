// SPDX-License-Identifier: BSD-3-Clause
#include "rejection_word.h"

namespace fild
{
Rejection parse_rejection(const CsvRow& row, std::size_t column)
{
    for (const auto rejection : all_rejections())
        if (to_word(rejection) == row.text(column)) return rejection;
    row.fail("'" + row.text(column) + "' is no reason to reject a frame");
}

}  // namespace fild
