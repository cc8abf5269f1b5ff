// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/features/global_descriptor.h"
#include "fild/features/surf.h"
#include "fild/matching/code_hasher.h"
#include "fild/places/place.h"

namespace fild
{
/** What is computed from a frame's pixels, before anything is hashed. Floating point local
 *  descriptors take half a kilobyte each: of use to hash them in several ways, not to be kept. */
struct FrameFeatures
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    Rejection defect = Rejection::none;  ///< as in Frame; there are no features then
    ImageAppearance appearance;
    LocalFeatures local;
};

/** All that the detector needs of a frame; the image itself is no longer needed. */
struct FrameDescription
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    Rejection defect = Rejection::none;  ///< as in Frame; the descriptors are then empty
    GlobalDescriptor global;
    HashedFeatures local;
    MetricView metric{};
};

/** Features of frames, FILD (IROS 2019) section III-A: the global descriptor by MobileNetV2, local
 *  features by SURF. Network and SURF run side by side when num_threads is not 1, the network in
 *  one thread, with the same result. Not thread-safe: one caller at a time. */
class FrameFeatureExtractor
{
 public:
    /** \throw std::runtime_error as GlobalDescriptorExtractor. */
    explicit FrameFeatureExtractor(const TDetectorOptions& options);

    /** \param times receives "global_descriptor" and "local_features". */
    FrameFeatures extract(const Frame& frame, StageTimes& times);

    /** Local features alone, of an image as Frame::image. */
    LocalFeatures extract_local(const cv::Mat& image) const
    {
        return surf_extractor_.extract(image);
    }

    std::size_t global_dimension() const { return global_extractor_.dimension(); }

 private:
    int num_threads_;
    GlobalDescriptorExtractor global_extractor_;
    SurfExtractor surf_extractor_;
};

/** Turns features into what the detector keeps: of local features binary codes and positions only.
 *  Const members may run concurrently. */
class FrameHasher
{
 public:
    explicit FrameHasher(const TDetectorOptions& options);

    FrameDescription hash(const FrameFeatures& features) const;
    /** Without cells. */
    HashedFeatures hash(const LocalFeatures& features) const;

 private:
    int num_threads_;
    int bits_;
    std::uint64_t seed_;
    CodeHasher hasher_;
};

/** Describes frames: features, then codes, then what metric poses take: depths of the keypoints
 *  from the frame's right image or depth image. Not thread-safe: one caller at a time. */
class FrameDescriber
{
 public:
    /** \throw std::runtime_error as GlobalDescriptorExtractor. */
    explicit FrameDescriber(const TDetectorOptions& options);

    /** \param times receives "global_descriptor", "local_features", "hashing" and, of a frame with
     *         depth to be had, "depth". */
    FrameDescription describe(const Frame& frame, StageTimes& times);

    std::size_t global_dimension() const { return extractor_.global_dimension(); }

 private:
    KeypointDepths depths_of(const Frame& frame, const HashedFeatures& local, StageTimes& times);

    FrameFeatureExtractor extractor_;
    FrameHasher hasher_;
    TDepthOptions depth_options_;
};

}  // namespace fild
