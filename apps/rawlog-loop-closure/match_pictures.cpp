// SPDX-License-Identifier: BSD-3-Clause
#include "match_pictures.h"

#include "fild/core/whole_file.h"
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
#include <utility>

namespace fild
{
namespace
{
/** Candidate images on their way to their last picture, as JPEG: thousands can be waiting at once.
 */
class CandidateImages
{
 public:
    explicit CandidateImages(const std::vector<LoopPicture>& pairs)
    {
        for (const auto& pair : pairs) ++waiting_[pair.verdict.candidate->frame].pictures;
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

LoopPicture to_loop_picture(const DetectorOutcome& outcome, double candidate_timestamp)
{
    LoopPicture loop{outcome.verdict, candidate_timestamp, {}};
    for (const auto k : outcome.inliers) loop.inliers.push_back(outcome.matches[k]);
    return loop;
}

std::string picture_name(const FrameVerdict& verdict)
{
    return std::to_string(to_index(verdict.frame)) + "_" +
           std::to_string(to_index(verdict.candidate->frame)) + ".png";
}

void write_picture(const LoopPicture& pair,
                   const cv::Mat& query_image,
                   const cv::Mat& candidate_image,
                   const std::filesystem::path& folder)
{
    const auto picture = draw_match_picture(
        {query_image, candidate_image, pair.verdict, pair.candidate_timestamp, pair.inliers});
    std::vector<unsigned char> png;
    cv::imencode(".png", picture, png);
    WholeFile file((folder / picture_name(pair.verdict)).string());
    file.stream().write(reinterpret_cast<const char*>(png.data()),
                        static_cast<std::streamsize>(png.size()));
    file.commit();
}

/** True for NUMBER_NUMBER.png and what a killed run left of one. */
bool is_picture_name(const std::string& name)
{
    constexpr const char* kDigits = "0123456789";
    const auto underscore = name.find_first_not_of(kDigits);
    if (underscore == 0 || underscore == std::string::npos || name[underscore] != '_') return false;
    const auto dot = name.find_first_not_of(kDigits, underscore + 1);
    if (dot == underscore + 1 || dot == std::string::npos) return false;
    const auto ending = name.substr(dot);
    return ending == ".png" || ending.rfind(".png.part-", 0) == 0;
}

/** Removes the pictures of an earlier run, and nothing else that may lie in the folder. */
void remove_old_pictures(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (is_picture_name(entry.path().filename().string())) old.push_back(entry.path());
    for (const auto& path : old) std::filesystem::remove(path);
}

/** Passes over the rawlog and draws the pairs, which stand in order of their queries. */
std::size_t draw_all(const std::vector<LoopPicture>& pairs,
                     const TInputOptions& input,
                     const std::string& rawlog,
                     const std::filesystem::path& folder)
{
    CandidateImages candidates(pairs);
    RawlogReader reader(rawlog);
    FrameBuilder builder(input, rawlog);
    auto next = pairs.begin();
    while (next != pairs.end() && !interrupted())
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
        if (frame.defect != Rejection::none)
            throw std::runtime_error("the image of frame " + std::to_string(to_index(id)) +
                                     " is gone since the run began");
        if (candidates.wants(id)) candidates.store(frame);
        if (!is_query) continue;
        write_picture(*next, frame.image, candidates.take(next->verdict.candidate->frame), folder);
        ++next;
    }
    return static_cast<std::size_t>(next - pairs.begin());
}
}  // namespace

PairsToDraw::PairsToDraw(TRenderOptions render, const TReportOptions& report)
    : render_(std::move(render)),
      max_rejected_(static_cast<std::size_t>(report.max_rejected_pictures))
{
}

void PairsToDraw::add(const DetectorOutcome& outcome, double candidate_timestamp)
{
    if (render_.max_match_pictures == 0) return;
    if (outcome.verdict.accepted())
        closures_.push_back(to_loop_picture(outcome, candidate_timestamp));
    else if (outcome.verdict.support > 0)
        add_rejected(outcome, candidate_timestamp);
}

void PairsToDraw::add_rejected(const DetectorOutcome& outcome, double candidate_timestamp)
{
    const auto place = std::upper_bound(rejected_.begin(),
                                        rejected_.end(),
                                        outcome.verdict.support,
                                        [](double support, const LoopPicture& other)
                                        { return support > other.verdict.support; });
    if (place == rejected_.end() && rejected_.size() >= max_rejected_) return;
    rejected_.insert(place, to_loop_picture(outcome, candidate_timestamp));
    if (rejected_.size() > max_rejected_) rejected_.pop_back();
}

std::vector<LoopPicture> PairsToDraw::chosen() const
{
    std::vector<FrameVerdict> verdicts;
    verdicts.reserve(closures_.size());
    for (const auto& loop : closures_) verdicts.push_back(loop.verdict);
    auto pairs = rejected_;
    for (const auto i : choose_match_pictures(verdicts, render_)) pairs.push_back(closures_[i]);
    std::sort(pairs.begin(),
              pairs.end(),
              [](const auto& a, const auto& b) { return a.verdict.frame < b.verdict.frame; });
    return pairs;
}

std::size_t draw_match_pictures(const std::vector<LoopPicture>& pairs,
                                const TInputOptions& input,
                                const std::string& rawlog,
                                const std::string& folder)
{
    std::filesystem::create_directories(folder);
    remove_old_pictures(folder);
    return draw_all(pairs, input, rawlog, folder);
}

}  // namespace fild
