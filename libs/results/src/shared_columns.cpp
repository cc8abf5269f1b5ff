// SPDX-License-Identifier: BSD-3-Clause
#include "shared_columns.h"

#include "fild/core/words.h"

namespace fild
{
Rejection parse_rejection(const CsvField& field)
{
    const auto rejection = rejection_of(field.text());
    if (!rejection) field.fail("'" + field.text() + "' is no reason to reject a frame");
    return *rejection;
}

bool parse_flag(const CsvField& field)
{
    if (field.text() != "0" && field.text() != "1")
        field.fail("'" + field.text() + "' is neither 0 nor 1");
    return field.text() == "1";
}

void require_frame(FrameId frame, std::size_t frames, const CsvReader& reader)
{
    if (to_index(frame) >= frames)
        reader.fail("frame " + std::to_string(to_index(frame)) + ", the run has " +
                    count_of(frames, "frame") + " from 0");
}

}  // namespace fild
