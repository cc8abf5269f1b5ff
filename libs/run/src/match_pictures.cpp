// SPDX-License-Identifier: BSD-3-Clause
#include "match_pictures.h"

#include "fild/core/parallel_for.h"
#include "fild/core/whole_file.h"
#include "fild/detector/pair_verifier.h"
#include "fild/job/interruption.h"
#include "fild/rawlog/pose_conversion.h"
#include "picture_file.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <future>
#include <map>
#include <set>
#include <utility>

namespace fild
{
namespace
{
std::string picture_name(const FrameVerdict& verdict, const std::string& variant = "")
{
    return std::to_string(to_index(verdict.frame)) + "_" +
           std::to_string(to_index(verdict.candidate->frame)) + variant + ".jpg";
}

/** True for NUMBER_NUMBER.jpg and NUMBER_NUMBER_3d.jpg. */
bool is_picture_name(const std::string& name)
{
    constexpr const char* kDigits = "0123456789";
    const auto underscore = name.find_first_not_of(kDigits);
    if (underscore == 0 || underscore == std::string::npos || name[underscore] != '_') return false;
    const auto end = name.find_first_not_of(kDigits, underscore + 1);
    if (end == underscore + 1 || end == std::string::npos) return false;
    const bool is_3d = name.compare(end, 3, "_3d") == 0;
    return name.substr(is_3d ? end + 3 : end) == ".jpg";
}

/** Removes the pictures of an earlier run, and nothing else that may lie in the folder. */
void remove_old_pictures(const std::filesystem::path& folder)
{
    remove_unfinished_in(folder.string());
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (is_picture_name(entry.path().filename().string())) old.push_back(entry.path());
    for (const auto& path : old) std::filesystem::remove(path);
}

CameraPair cameras_of(const LoopEdge& loop, const MetricView& query, const MetricView& candidate)
{
    const auto on_robot = [](const MetricView& view)
    { return view.robot_from_camera.value_or(RigidTransform()); };
    return {*query.camera,
            *candidate.camera,
            on_robot(candidate).inverse() * rigid_transform_from(loop.motion->a_from_b) *
                on_robot(query)};
}
}  // namespace

PairsToDraw::PairsToDraw(TRenderOptions render,
                         const TReportOptions& report,
                         double support_threshold)
    : render_(std::move(render)),
      max_rejected_(static_cast<std::size_t>(report.max_rejected_pictures)),
      support_threshold_(support_threshold)
{
}

void PairsToDraw::add(const FrameVerdict& verdict, double candidate_timestamp)
{
    if (!render_.enabled || render_.max_match_pictures == 0) return;
    LoopPicture pair{verdict, candidate_timestamp};
    pair.support_threshold = support_threshold_;
    if (verdict.accepted())
        closures_.push_back(std::move(pair));
    else if (verdict.support > 0)
        add_rejected(std::move(pair));
}

void PairsToDraw::add_rejected(LoopPicture pair)
{
    const auto place = std::upper_bound(rejected_.begin(),
                                        rejected_.end(),
                                        pair.verdict.support,
                                        [](double support, const LoopPicture& other)
                                        { return support > other.verdict.support; });
    if (place == rejected_.end() && rejected_.size() >= max_rejected_) return;
    rejected_.insert(place, std::move(pair));
    if (rejected_.size() > max_rejected_) rejected_.pop_back();
}

std::vector<std::size_t> PairsToDraw::chosen_closures(const std::set<FrameId>& wrong) const
{
    std::vector<FrameVerdict> wrong_verdicts;
    std::vector<FrameVerdict> other_verdicts;
    std::vector<std::size_t> wrong_closures;
    std::vector<std::size_t> other_closures;
    for (std::size_t i = 0; i < closures_.size(); ++i)
    {
        const auto& verdict = closures_[i].verdict;
        const bool is_wrong = wrong.count(verdict.frame) != 0;
        (is_wrong ? wrong_verdicts : other_verdicts).push_back(verdict);
        (is_wrong ? wrong_closures : other_closures).push_back(i);
    }
    auto render = render_;
    std::vector<std::size_t> chosen;
    for (const auto i : choose_match_pictures(wrong_verdicts, render))
        chosen.push_back(wrong_closures[i]);
    render.max_match_pictures -= static_cast<int>(chosen.size());
    for (const auto i : choose_match_pictures(other_verdicts, render))
        chosen.push_back(other_closures[i]);
    return chosen;
}

std::vector<LoopPicture> PairsToDraw::chosen(const std::set<FrameId>& wrong) const
{
    auto pairs = rejected_;
    for (const auto i : chosen_closures(wrong)) pairs.push_back(closures_[i]);
    std::sort(pairs.begin(),
              pairs.end(),
              [](const auto& a, const auto& b) { return a.verdict.frame < b.verdict.frame; });
    return pairs;
}

void add_matches(std::vector<LoopPicture>& pairs,
                 const PlaceMap& places,
                 const TDetectorOptions& options,
                 bool with_rejected)
{
    const PairVerifier verifier(options);
    parallel_for(options.runtime.num_threads,
                 pairs.size(),
                 [&](std::size_t i)
                 {
                     auto& pair = pairs[i];
                     const auto& query = places.find(pair.verdict.frame)->local;
                     const auto& candidate = places.find(pair.verdict.candidate->frame)->local;
                     StageTimes not_of_a_frame;
                     const auto verified = verifier.verify(query, candidate, not_of_a_frame);
                     const auto& inliers = verified.verification.inliers;
                     for (std::size_t k = 0; k < verified.matches.size(); ++k)
                     {
                         const auto& match = verified.matches[k];
                         const PixelPair pixels{query.positions[match.query],
                                                candidate.positions[match.candidate]};
                         if (std::binary_search(inliers.begin(), inliers.end(), k))
                             pair.inliers.push_back(pixels);
                         else if (with_rejected)
                             pair.rejected.push_back(pixels);
                     }
                 });
}

void add_cameras(std::vector<LoopPicture>& pairs, const Map& map, const PlaceMap& places)
{
    std::map<FrameId, const LoopEdge*> metric;
    for (const auto& loop : map.loops)
        if (loop.motion) metric[loop.query] = &loop;
    for (auto& pair : pairs)
    {
        const auto loop = metric.find(pair.verdict.frame);
        if (!pair.verdict.accepted() || loop == metric.end()) continue;
        const auto* query = places.find(loop->second->query);
        const auto* candidate = places.find(loop->second->candidate);
        pair.cameras = cameras_of(*loop->second, query->metric, candidate->metric);
    }
}

/** Candidate images on their way to their last picture: thousands can be waiting at once, so that
 *  those beyond some memory wait as JPEG. */
class MatchPictures::CandidateImages
{
 public:
    explicit CandidateImages(const std::vector<LoopPicture>& pairs)
    {
        for (const auto& pair : pairs) ++waiting_[pair.verdict.candidate->frame].pictures;
    }

    bool wants(FrameId frame) const { return waiting_.count(frame) != 0; }

    void store(const Frame& frame)
    {
        constexpr std::size_t kRoom = 64U << 20U;  // bytes
        auto& entry = waiting_.at(frame.id);
        const auto size = bytes_of(frame.image);
        if (held_ + size <= kRoom)
        {
            entry.image = frame.image;
            held_ += size;
        }
        else
            cv::imencode(".jpg", frame.image, entry.jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
    }

    cv::Mat take(FrameId frame)
    {
        auto& entry = waiting_.at(frame);
        cv::Mat image =
            entry.image.empty() ? cv::imdecode(entry.jpeg, cv::IMREAD_UNCHANGED) : entry.image;
        if (--entry.pictures == 0)
        {
            held_ -= bytes_of(entry.image);
            waiting_.erase(frame);
        }
        return image;
    }

 private:
    static std::size_t bytes_of(const cv::Mat& image) { return image.total() * image.elemSize(); }

    struct Entry
    {
        std::size_t pictures = 0;  ///< still to be drawn with this image
        cv::Mat image;
        std::vector<unsigned char> jpeg;  ///< instead
    };
    std::map<FrameId, Entry> waiting_;
    std::size_t held_ = 0;  ///< bytes in images
};

/** Draws pairs as their images come: a batch while the caller reads the images of the next. */
class MatchPictures::Drawing
{
 public:
    Drawing(const TRenderOptions& options, int num_threads, std::filesystem::path folder)
        : options_(options), num_threads_(num_threads), folder_(std::move(folder))
    {
    }

    void add(const LoopPicture& pair, const cv::Mat& query_image, const cv::Mat& candidate_image)
    {
        constexpr std::size_t kBatch = 16;
        next_.push_back({&pair,
                         {query_image,
                          candidate_image,
                          pair.verdict,
                          pair.candidate_timestamp,
                          pair.inliers,
                          pair.rejected,
                          pair.support_threshold}});
        if (next_.size() == kBatch) draw_next();
    }

    /** \return how many pairs were drawn. */
    std::size_t finish()
    {
        draw_next();
        await_drawn();
        return drawn_;
    }

 private:
    struct Pair
    {
        const LoopPicture* pair;
        MatchPicture picture;
    };

    std::string path_of(const Pair& pair, const std::string& variant = "") const
    {
        return (folder_ / picture_name(pair.pair->verdict, variant)).string();
    }

    void draw_next()
    {
        await_drawn();
        being_drawn_ = std::move(next_);
        next_.clear();
        drawing_ = std::async(std::launch::async, [this] { draw(); });
    }

    void draw() const
    {
        parallel_for(num_threads_,
                     being_drawn_.size(),
                     [&](std::size_t i)
                     {
                         write_picture(path_of(being_drawn_[i]),
                                       draw_match_picture(being_drawn_[i].picture, options_));
                     });
    }

    /** Waits for the batch, and draws what needs OpenGL, which this thread has. */
    void await_drawn()
    {
        if (drawing_.valid()) drawing_.get();
        for (const auto& pair : being_drawn_)
            if (pair.pair->cameras && !interrupted())
                write_picture(path_of(pair, "_3d"),
                              draw_match_picture_3d(pair.picture, *pair.pair->cameras, options_));
        drawn_ += being_drawn_.size();
        being_drawn_.clear();
    }

    const TRenderOptions& options_;
    int num_threads_;
    std::filesystem::path folder_;
    std::vector<Pair> next_;
    std::vector<Pair> being_drawn_;
    std::size_t drawn_ = 0;
    std::future<void> drawing_;  ///< the last member: its end is awaited before the others go
};

MatchPictures::MatchPictures(std::vector<LoopPicture> pairs,
                             const TRenderOptions& options,
                             int num_threads,
                             const std::string& folder)
    : pairs_(std::move(pairs)),
      next_(pairs_.cbegin()),
      candidates_(std::make_unique<CandidateImages>(pairs_)),
      drawing_(std::make_unique<Drawing>(options, num_threads, folder))
{
    std::filesystem::create_directories(folder);
    remove_old_pictures(folder);
}

MatchPictures::~MatchPictures() = default;

std::set<FrameId> MatchPictures::wanted() const
{
    std::set<FrameId> frames;
    for (const auto& pair : pairs_)
        frames.insert({pair.verdict.frame, pair.verdict.candidate->frame});
    return frames;
}

void MatchPictures::take(const Frame& frame)
{
    if (candidates_->wants(frame.id)) candidates_->store(frame);
    if (next_ == pairs_.cend() || next_->verdict.frame != frame.id) return;
    const auto candidate = candidates_->take(next_->verdict.candidate->frame);
    drawing_->add(*next_++, frame.image, candidate);
}

std::size_t MatchPictures::finish()
{
    return drawing_->finish();
}

}  // namespace fild
