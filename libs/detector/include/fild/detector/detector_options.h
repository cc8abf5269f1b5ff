// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/detector/same_place_model.h"
#include "fild/features/global_descriptor_options.h"
#include "fild/features/local_feature_options.h"
#include "fild/geometry/depth_options.h"
#include "fild/geometry/relative_pose_options.h"
#include "fild/geometry/verification_options.h"
#include "fild/index/index_options.h"
#include "fild/matching/hashing_options.h"

#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** Section [candidates]: which earlier frames are verified for a query beyond the nearest
 * neighbours of its descriptor. With the defaults nothing but those, as in the paper. */
struct TCandidateOptions : Options
{
    /** Of nearest neighbours at most so many frames apart only the most similar is verified: they
     *  show one place, and neighbour_reach finds the best of its frames. 0: all are. */
    int place_frames = 0;
    /** From the best candidate on, frames of the same camera before and after it are verified too,
     *  for as long as one of the next so many is better: the nearest descriptor along a street is
     *  often that of a frame some metres off. 0: none. */
    int neighbour_reach = 0;
    /** The place that the belief of [consistency] holds for the likeliest is a candidate, too. */
    bool follow_belief = false;
    /** Candidates are verified, most promising first, until one is good; otherwise all are, and the
     *  best counts. */
    bool stop_at_first = false;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Section [consistency]: what the frames before say of a frame's candidate. */
struct TConsistencyOptions : Options
{
    /** true: a belief over the places of the map is carried from frame to frame, see PlaceBelief;
     *  needs [same_place]. false: consecutive_frames, as in the paper. */
    bool belief = false;
    double return_probability = 0.2;  ///< that a camera on new ground comes back to a known place
    double look_alike_share = 0.3;  ///< of what seems to be a return, the part that only looks so
    double leave_probability = 0.02;  ///< that it leaves the known places again, a frame
    double jump_probability = 0.05;  ///< that its next place is not near the one before
    int place_step = 3;  ///< places that it may move along the earlier path in a frame
    /** How much each frame counts against a look-alike; less than 1, since a look-alike that
     *  deceives in one frame does so in the next. */
    double look_alike_weight = 0.5;
    int consecutive_frames = 2;  ///< beta: so many verified frames in a row, the last is accepted
    /** Their candidates must follow one another within this many seconds of the recording, so that
     * a row cannot be made of different wrong places. 0: any candidates, as in the paper. */
    double max_candidate_step_seconds = 0;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Section [runtime]. */
struct TRuntimeOptions : Options
{
    int seed = 1;  ///< of hash projections, graph layers and RANSAC samples
    int num_threads = 1;  ///< 0: as many as the hardware has; the results are the same

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Options of every stage of the detector, one section of the .ini file each. */
struct TDetectorOptions
{
    TGlobalDescriptorOptions global_descriptor;
    TIndexOptions index;
    TLocalFeatureOptions local_features;
    THashingOptions hashing;
    TCandidateOptions candidates;
    TVerificationOptions verification;
    TSamePlaceOptions same_place;
    TConsistencyOptions consistency;
    TDepthOptions depth;
    TRelativePoseOptions relative_pose;
    TRuntimeOptions runtime;

    /** The sections by name, in the order of the pipeline. */
    std::vector<std::pair<std::string, Options*>> sections();
    /** \throw std::invalid_argument when options of different sections contradict each other. */
    void check_between_sections() const;
};

}  // namespace fild
