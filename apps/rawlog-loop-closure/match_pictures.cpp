// SPDX-License-Identifier: BSD-3-Clause
#include "match_pictures.h"

#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"
#include "fild/render/match_picture.h"
#include "interruption.h"

#include <mrpt/obs/CObservation.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <unistd.h>

namespace fild
{
namespace
{
/** Candidate images on their way to their last picture, as JPEG: thousands can be waiting at once.
 */
class CandidateImages
{
 public:
    explicit CandidateImages(const std::vector<LoopPicture>& loops)
    {
        for (const auto& loop : loops) ++waiting_[loop.verdict.candidate->frame].pictures;
    }

    bool wants(FrameId frame) const { return waiting_.count(frame) != 0; }

    void store(const Frame& frame)
    {
        cv::imencode(
            ".jpg", frame.image, waiting_.at(frame.id).jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
    }

    cv::Mat take(FrameId frame)
    {
        auto& entry = waiting_.at(frame);
        cv::Mat image = cv::imdecode(entry.jpeg, cv::IMREAD_UNCHANGED);
        if (--entry.pictures == 0) waiting_.erase(frame);
        return image;
    }

 private:
    struct Entry
    {
        std::size_t pictures = 0;  ///< still to be drawn with this image
        std::vector<unsigned char> jpeg;
    };
    std::map<FrameId, Entry> waiting_;
};

std::vector<LoopPicture> chosen_loops(const std::vector<LoopPicture>& loops,
                                      const TRenderOptions& options)
{
    std::vector<FrameVerdict> verdicts;
    verdicts.reserve(loops.size());
    for (const auto& loop : loops) verdicts.push_back(loop.verdict);
    std::vector<LoopPicture> chosen;
    for (const auto i : choose_match_pictures(verdicts, options)) chosen.push_back(loops[i]);
    return chosen;
}

void write_picture(const LoopPicture& loop,
                   const cv::Mat& query_image,
                   const cv::Mat& candidate_image,
                   const std::filesystem::path& folder)
{
    const auto picture = draw_match_picture(
        {query_image, candidate_image, loop.verdict, loop.candidate_timestamp, loop.inliers});
    const auto path = folder / (std::to_string(to_index(loop.verdict.frame)) + "_" +
                                std::to_string(to_index(loop.verdict.candidate->frame)) + ".png");
    if (!cv::imwrite(path.string(), picture))
        throw std::runtime_error("cannot write " + path.string() + ": is the disk full?");
}

/** Passes over the rawlog and draws the loops, which stand in order of their queries. */
std::size_t draw_all(const std::vector<LoopPicture>& loops,
                     const TInputOptions& input,
                     const std::string& rawlog,
                     const std::filesystem::path& folder)
{
    CandidateImages candidates(loops);
    RawlogReader reader(rawlog);
    FrameBuilder builder(input, rawlog);
    auto next = loops.begin();
    while (next != loops.end() && !interrupted())
    {
        const auto observation = reader.next();
        if (!observation) break;
        if (!builder.accepts(*observation)) continue;
        const auto id = builder.next_id();
        const bool is_query = next->verdict.frame == id;
        if (!is_query && !candidates.wants(id))
        {
            builder.skip(*observation);
            continue;
        }
        const auto frame = builder.build(*observation);
        if (candidates.wants(id)) candidates.store(frame);
        if (!is_query) continue;
        write_picture(*next, frame.image, candidates.take(next->verdict.candidate->frame), folder);
        ++next;
    }
    return static_cast<std::size_t>(next - loops.begin());
}
}  // namespace

LoopPicture to_loop_picture(const DetectorOutcome& outcome, double candidate_timestamp)
{
    LoopPicture loop{outcome.verdict, candidate_timestamp, {}};
    for (const auto k : outcome.inliers) loop.inliers.push_back(outcome.matches[k]);
    return loop;
}

std::size_t draw_match_pictures(const std::vector<LoopPicture>& loops,
                                const TRenderOptions& options,
                                const TInputOptions& input,
                                const std::string& rawlog,
                                const std::string& folder)
{
    const std::filesystem::path unfinished = folder + ".part-" + std::to_string(::getpid());
    std::filesystem::create_directory(unfinished);
    try
    {
        const auto drawn = draw_all(chosen_loops(loops, options), input, rawlog, unfinished);
        std::filesystem::remove_all(folder);
        std::filesystem::rename(unfinished, folder);
        return drawn;
    }
    catch (const std::exception&)
    {
        std::filesystem::remove_all(unfinished);
        throw;
    }
}

}  // namespace fild
