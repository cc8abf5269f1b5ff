// SPDX-License-Identifier: BSD-3-Clause
// Features of FILD (An et al., IROS 2019), section III-A.
#include "fild/detector/frame_describer.h"

#include <future>

namespace fild
{
namespace
{
std::vector<PixelPosition> positions_of(const LocalFeatures& features)
{
    std::vector<PixelPosition> positions;
    positions.reserve(features.size());
    for (const auto& keypoint : features.keypoints) positions.push_back({keypoint.x, keypoint.y});
    return positions;
}
}  // namespace

FrameFeatureExtractor::FrameFeatureExtractor(const TDetectorOptions& options)
    : num_threads_(options.runtime.num_threads),
      global_extractor_(options.global_descriptor),
      surf_extractor_(options.local_features, num_threads_)
{
}

FrameFeatures FrameFeatureExtractor::extract(const Frame& frame, StageTimes& times)
{
    FrameFeatures features{frame.id, frame.timestamp, frame.sensor_label, frame.defect, {}, {}};
    if (frame.defect != Rejection::none) return features;

    StageTimes network_times;  // of its own: StageTimes takes one caller at a time
    const auto policy = num_threads_ == 1 ? std::launch::deferred : std::launch::async;
    auto global = std::async(policy,
                             [&]
                             {
                                 const StageTimer timer(network_times, "global_descriptor");
                                 return global_extractor_.extract(frame.image);
                             });
    {
        const StageTimer timer(times, "local_features");
        features.local = surf_extractor_.extract(frame.image);
    }
    features.global = global.get();
    times.merge(network_times);
    return features;
}

FrameHasher::FrameHasher(const TDetectorOptions& options)
    : num_threads_(options.runtime.num_threads),
      hasher_(options.hashing,
              surf_descriptor_centre(),
              static_cast<std::uint64_t>(options.runtime.seed))
{
}

FrameDescription FrameHasher::hash(const FrameFeatures& features) const
{
    FrameDescription description{
        features.frame, features.timestamp, features.sensor_label, features.defect, {}, {}};
    if (features.defect != Rejection::none) return description;
    description.global = features.global;
    description.local = {positions_of(features.local), hasher_.hash(features.local, num_threads_)};
    return description;
}

FrameDescriber::FrameDescriber(const TDetectorOptions& options)
    : extractor_(options), hasher_(options)
{
}

FrameDescription FrameDescriber::describe(const Frame& frame, StageTimes& times)
{
    const auto features = extractor_.extract(frame, times);
    if (features.defect != Rejection::none) return hasher_.hash(features);
    const StageTimer timer(times, "hashing");
    return hasher_.hash(features);
}

}  // namespace fild
