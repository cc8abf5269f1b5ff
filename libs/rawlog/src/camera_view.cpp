// SPDX-License-Identifier: BSD-3-Clause
#include "camera_view.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

namespace fild
{
std::optional<CameraView> camera_view_of(const mrpt::obs::CObservation& observation)
{
    using namespace mrpt::obs;
    if (const auto* mono = dynamic_cast<const CObservationImage*>(&observation))
        return CameraView{mono->image, mono->cameraParams};
    if (const auto* stereo = dynamic_cast<const CObservationStereoImages*>(&observation))
        return CameraView{stereo->imageLeft, stereo->leftCamera};
    const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
    if (scan != nullptr && scan->hasIntensityImage)
        return CameraView{scan->intensityImage, scan->cameraParamsIntensity};
    return std::nullopt;
}

}  // namespace fild
