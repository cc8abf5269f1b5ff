// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/verdict.h"
#include "fild/mapping/map_builder.h"
#include "fild/places/place_map.h"
#include "fild/render/match_picture.h"
#include "fild/render/render_options.h"
#include "fild/report/report_options.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fild
{
/** What is kept of a loop closure, or of a rejected pair, until its picture is drawn. */
struct LoopPicture
{
    FrameVerdict verdict;
    double candidate_timestamp = 0;  ///< seconds since the UNIX epoch
    std::vector<PixelPair> inliers{};
    std::vector<PixelPair> rejected{};  ///< the other matches, where they are drawn
    std::optional<CameraPair> cameras{};  ///< for a picture in 3D as well
    double support_threshold = 1;  ///< of an accepted frame
};

/** Chooses of which pairs of a run pictures are drawn: loop closures as [render] says, and of the
 *  rejected pairs those with most support. Not thread-safe: one caller at a time. */
class PairsToDraw
{
 public:
    /** With no pictures of loop closures there are none of rejected pairs either.
     *  \param support_threshold  support from which frames are accepted: for captions. */
    PairsToDraw(TRenderOptions render, const TReportOptions& report, double support_threshold);

    /** \param verdict  with a candidate. */
    void add(const FrameVerdict& verdict, double candidate_timestamp);

    /** In order of their queries, without matches. \param wrong  loop closures that come before all
     *  others. */
    std::vector<LoopPicture> chosen(const std::set<FrameId>& wrong = {}) const;

 private:
    std::vector<std::size_t> chosen_closures(const std::set<FrameId>& wrong) const;
    void add_rejected(LoopPicture pair);

    TRenderOptions render_;
    std::size_t max_rejected_;
    double support_threshold_;
    std::vector<LoopPicture> closures_;
    std::vector<LoopPicture> rejected_;  ///< most support first
};

/** Matches the pairs anew, as the detector did: only the few that are drawn take memory for that.
 *  \param options  of the detector that the places come from. */
void add_matches(std::vector<LoopPicture>& pairs,
                 const PlaceMap& places,
                 const TDetectorOptions& options,
                 bool with_rejected);

/** Tells the pairs that are loops with a metric pose where their cameras stood.
 *  \param places  that the map was made of. */
void add_cameras(std::vector<LoopPicture>& pairs, const Map& map, const PlaceMap& places);

/** Draws pairs, whose images come one by one, as QUERY_CANDIDATE.jpg, and those with cameras as
 *  QUERY_CANDIDATE_3d.jpg too, into a folder. An interruption ends it early. Not thread-safe: one
 *  caller at a time. */
class MatchPictures
{
 public:
    /** Removes the pictures of an earlier run.
     *  \param pairs  in order of their queries. \throw std::filesystem::filesystem_error */
    MatchPictures(std::vector<LoopPicture> pairs,
                  const TRenderOptions& options,
                  int num_threads,
                  const std::string& folder);
    MatchPictures(const MatchPictures&) = delete;
    MatchPictures& operator=(const MatchPictures&) = delete;
    ~MatchPictures();

    /** The frames whose images are needed. */
    std::set<FrameId> wanted() const;

    /** \param frame  wanted, and later than those before.
     *  \throw std::runtime_error when a picture cannot be written. */
    void take(const Frame& frame);

    /** \return how many pairs were drawn. \throw std::runtime_error as take(). */
    std::size_t finish();

 private:
    class CandidateImages;
    class Drawing;

    std::vector<LoopPicture> pairs_;
    std::vector<LoopPicture>::const_iterator next_;
    std::unique_ptr<CandidateImages> candidates_;
    std::unique_ptr<Drawing> drawing_;
};

}  // namespace fild
