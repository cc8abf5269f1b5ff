// SPDX-License-Identifier: BSD-3-Clause
#include "frame_pass.h"

#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/paired_rawlog.h"
#include "interruption.h"

#include <mrpt/obs/CObservation.h>

#include <stdexcept>

namespace fild
{
void for_each_frame(const std::string& rawlog,
                    const TInputOptions& input,
                    const std::set<FrameId>& wanted,
                    const std::function<void(const Frame&)>& visit)
{
    if (wanted.empty()) return;
    PairedRawlog reader(rawlog, input);
    FrameBuilder builder(input, rawlog);
    while (builder.next_id() <= *wanted.rbegin() && !interrupted())
    {
        const auto observation = reader.next();
        if (!observation) break;
        if (!builder.accepts(*observation)) continue;
        const auto id = builder.next_id();
        if (wanted.count(id) == 0)
        {
            builder.skip(*observation);
            continue;
        }
        const auto frame = builder.build(*observation);
        if (frame.defect != Rejection::none)
            throw std::runtime_error("the image of frame " + std::to_string(to_index(id)) +
                                     " is gone since the run began");
        visit(frame);
    }
}

}  // namespace fild
