// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/features/global_descriptor.h"
#include "fild/features/surf.h"
#include "fild/matching/code_hasher.h"

namespace fild
{
/** All that the detector needs of a frame; the image itself is no longer needed. */
struct FrameDescription
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    Rejection defect = Rejection::none;  ///< as in Frame; the descriptors are then empty
    GlobalDescriptor global;
    HashedFeatures local;
};

/** Describes frames, FILD (IROS 2019) section III-A: the global descriptor by MobileNetV2, local
 *  features by SURF turned into binary codes. Only codes and keypoint positions leave here, never
 *  floating point local descriptors. Network and SURF run side by side when num_threads is not 1,
 * with the same result. Not thread-safe: one caller at a time. */
class FrameDescriber
{
 public:
    /** \throw std::runtime_error as GlobalDescriptorExtractor. */
    explicit FrameDescriber(const TDetectorOptions& options);

    /** \param times receives "global_descriptor", "local_features" and "hashing". */
    FrameDescription describe(const Frame& frame, StageTimes& times);

    std::size_t global_dimension() const { return global_extractor_.dimension(); }

 private:
    int num_threads_;
    GlobalDescriptorExtractor global_extractor_;
    SurfExtractor surf_extractor_;
    CodeHasher hasher_;
};

}  // namespace fild
