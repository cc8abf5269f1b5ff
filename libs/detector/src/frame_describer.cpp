// SPDX-License-Identifier: BSD-3-Clause
// Features of FILD (An et al., IROS 2019), section III-A.
#include "fild/detector/frame_describer.h"

#include "fild/geometry/image_depths.h"
#include "fild/geometry/stereo_depths.h"
#include "fild/matching/cell_hasher.h"

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

std::vector<KeypointShape> shapes_of(const LocalFeatures& features)
{
    std::vector<KeypointShape> shapes;
    shapes.reserve(features.size());
    for (const auto& keypoint : features.keypoints) shapes.push_back(shape_of(keypoint));
    return shapes;
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
    auto appearance = std::async(policy,
                                 [&]
                                 {
                                     const StageTimer timer(network_times, "global_descriptor");
                                     return global_extractor_.extract(frame.image);
                                 });
    {
        const StageTimer timer(times, "local_features");
        features.local = surf_extractor_.extract(frame.image);
    }
    features.appearance = appearance.get();
    times.merge(network_times);
    return features;
}

FrameHasher::FrameHasher(const TDetectorOptions& options)
    : num_threads_(options.runtime.num_threads),
      bits_(options.hashing.bits),
      seed_(static_cast<std::uint64_t>(options.runtime.seed)),
      hasher_(options.hashing,
              options.hashing.rooted ? rooted_surf_statistics() : surf_statistics(),
              seed_)
{
}

FrameDescription FrameHasher::hash(const FrameFeatures& features) const
{
    FrameDescription description{
        features.frame, features.timestamp, features.sensor_label, features.defect, {}, {}};
    if (features.defect != Rejection::none) return description;
    description.global = features.appearance.global;
    description.local = hash(features.local);
    description.local.cells = hash_cells(features.appearance.cells, bits_, seed_);
    return description;
}

HashedFeatures FrameHasher::hash(const LocalFeatures& features) const
{
    return {positions_of(features),
            hasher_.hash(features, num_threads_),
            shapes_of(features),
            features.image_size};
}

FrameDescriber::FrameDescriber(const TDetectorOptions& options)
    : extractor_(options), hasher_(options), depth_options_(options.depth)
{
    depth_options_.check();
}

FrameDescription FrameDescriber::describe(const Frame& frame, StageTimes& times)
{
    const auto features = extractor_.extract(frame, times);
    if (features.defect != Rejection::none) return hasher_.hash(features);
    FrameDescription description;
    {
        const StageTimer timer(times, "hashing");
        description = hasher_.hash(features);
    }
    auto& metric = description.metric;
    metric.robot_from_camera = frame.robot_from_camera;
    metric.depth_defect = frame.depth_defect;
    if (frame.camera && frame.camera->lens == LensModel::none) metric.camera = frame.camera;
    if (metric.camera) metric.depths = depths_of(frame, description.local, times);
    return description;
}

KeypointDepths FrameDescriber::depths_of(const Frame& frame,
                                         const HashedFeatures& local,
                                         StageTimes& times)
{
    const auto source = depth_source_of(frame);
    if (source == DepthSource::none) return {};
    const StageTimer timer(times, "depth");
    if (source == DepthSource::depth_image)
        return depths_from_image(frame, local.positions, depth_options_);
    const auto right = hasher_.hash(extractor_.extract_local(frame.right->image));
    return depths_from_stereo(frame, local, right, depth_options_);
}

}  // namespace fild
