// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/recording.h"

#include <utility>

namespace fild
{
Recording mono_recording(std::vector<StampedImage> images,
                         const std::optional<Calibration>& calibration)
{
    Recording recording;
    recording.calibration = calibration;
    recording.frames.reserve(images.size());
    for (auto& image : images)
        recording.frames.push_back({std::move(image), std::nullopt, std::nullopt});
    return recording;
}

}  // namespace fild
