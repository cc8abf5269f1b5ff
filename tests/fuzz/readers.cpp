// SPDX-License-Identifier: BSD-3-Clause
#include "readers.h"

#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/loop_labels.h"
#include "fild/features/global_descriptor.h"
#include "fild/features/surf.h"
#include "fild/mapping/map_builder.h"
#include "fild/rawlog/calibration_file.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/image_list.h"
#include "fild/rawlog/rawlog_reader.h"
#include "fild/rawlog/robot_path_file.h"
#include "fild/results/candidates_csv.h"
#include "fild/results/costs_csv.h"
#include "fild/results/frames_csv.h"
#include "fild/results/loops_csv.h"
#include "fild/results/poses_csv.h"
#include "fild/stream/loop_closure_stream.h"
#include "rawlog/drawn_rawlog.h"

#include <cmath>
#include <filesystem>

namespace fild::fuzz
{
namespace
{
/** Frames of a rawlog's camera, with what metric poses take, and their keypoints. */
class FrameReader
{
 public:
    explicit FrameReader(const std::string& rawlog)
        : builder_(fitting({}, rawlog), rawlog, FrameContent::metric)
    {
    }

    void read(const mrpt::obs::CObservation& observation)
    {
        for (const auto& ready : pairing_.feed(observation)) read_ready(*ready);
        if (!pairing_.takes(observation)) read_ready(observation);
    }

    void finish()
    {
        for (const auto& ready : pairing_.finish()) read_ready(*ready);
    }

 private:
    void read_ready(const mrpt::obs::CObservation& observation)
    {
        if (!builder_.accepts(observation)) return;
        const auto frame = builder_.build(observation);
        if (!std::isfinite(frame.timestamp)) throw Finding("a time stamp that is no number");
        if (frame.defect == Rejection::none) surf_.extract(frame.image);
    }

    static TInputOptions fitting(TInputOptions options, const std::string& rawlog)
    {
        options.images_dir = std::filesystem::path(rawlog).parent_path().string();
        return options;
    }

    StereoPairing pairing_{TInputOptions()};
    FrameBuilder builder_;
    SurfExtractor surf_{TLocalFeatureOptions()};
};

/** Until the end, or the damage. \return entries read. */
std::size_t read_entries(const std::string& path)
{
    std::size_t entries = 0;
    try
    {
        RawlogReader reader(path);
        FrameReader frames(path);
        MapBuilder map({}, {});
        for (auto entry = reader.next_entry(); entry.observation || entry.actions;
             entry = reader.next_entry())
        {
            ++entries;
            if (entry.actions) map.feed(*entry.actions);
            if (!entry.observation) continue;
            map.feed(*entry.observation);
            frames.read(*entry.observation);
        }
        frames.finish();
    }
    catch (const TruncatedRawlog& damage)
    {
        entries = damage.entries_read;
    }
    return entries;
}

void read_rawlog(const std::string& path, std::size_t good_entries)
{
    const auto entries = read_entries(path);
    if (entries < good_entries)
        throw Finding(std::to_string(entries) + " entries of " + std::to_string(good_entries) +
                      " before the damage were read");
}

std::vector<FrameVerdict> two_frames()
{
    std::vector<FrameVerdict> frames(2);
    frames[1].frame = FrameId{1};
    frames[1].timestamp = 1;
    return frames;
}

void read_list(const std::string& reader, const std::string& path)
{
    if (reader == "labels") read_loop_list(path);
    if (reader == "tum") read_tum_poses(path, two_frames());
    if (reader == "tum_path") read_camera_path(path);
    if (reader == "kitti") read_kitti_poses(path, two_frames());
    if (reader == "images") read_image_list(path);
    if (reader == "calibration") read_calibration_file(path);
}

void read_network(const std::string& reader, const std::string& path)
{
    TGlobalDescriptorOptions options;
    options.model_file = path;
    options.backend = reader == "opencv" ? Backend::opencv : Backend::onednn;
    options.layers = "vector";
    options.input_width = 24;
    options.input_height = 20;
    GlobalDescriptorExtractor network(options);
    if (network.extract(testing::draw_image()).global.empty()) throw Finding("an empty descriptor");
}

/** As an external image of a rawlog, twice. */
void read_image(const std::string& path)
{
    FrameReader frames(path);
    const auto name = std::filesystem::path(path).filename().string();
    for (int i = 0; i < 2; ++i) frames.read(*testing::external_observation(name, i));
}
}  // namespace

void read_file(Kind kind,
               const std::string& reader,
               const std::string& path,
               std::size_t good_entries)
{
    switch (kind)
    {
        case Kind::rawlog:
        case Kind::rawlog_gz:
            read_rawlog(path, good_entries);
            break;
        case Kind::ini:
            load_stream_options(path);
            break;
        case Kind::mat:
            read_loop_matrix(path);
            break;
        case Kind::csv:
            if (reader == "frames") read_frames_csv(path);
            if (reader == "poses") read_poses_csv(path, 12);
            if (reader == "candidates") read_candidates_csv(path, 12);
            if (reader == "loops") read_loops_csv(path);
            if (reader == "costs") read_costs_csv(path, 5);
            break;
        case Kind::list:
            read_list(reader, path);
            break;
        case Kind::onnx:
            read_network(reader, path);
            break;
        case Kind::jpg:
        case Kind::png:
            read_image(path);
            break;
    }
}

}  // namespace fild::fuzz
