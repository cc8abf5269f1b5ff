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
    /** How many places are verified: among the nearest neighbours, those with most
     *  agreeing_cells(), best first. Needs [global_descriptor] cell_layer. 0: all neighbours are,
     *  most similar first. */
    int best_by_cells = 0;
    /** Of nearest neighbours at most `place_frames` frames of a camera apart only the most similar
     *  is verified: they show one place, and neighbour_reach finds its best frame. 0: all are
     *  verified. */
    int place_frames = 0;
    /** Frames of the same camera before and after the best candidate are verified too, until
     *  `neighbour_reach` in a row are no better: along a street the nearest descriptor is often a
     *  few metres off. 0: off. */
    int neighbour_reach = 0;
    /** The most probable place of the belief of [consistency] is a candidate, too. */
    bool follow_belief = false;
    /** Candidates are verified in order of promise until one is accepted. false: all are verified,
     *  and the best counts. */
    bool stop_at_first = false;

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Section [consistency]: how earlier and later frames affect the verdict on a frame. */
struct TConsistencyOptions : Options
{
    /** true: a belief over the places of the map is carried from frame to frame, see PlaceBelief;
     *  needs [same_place]. false: consecutive_frames, as in the paper. */
    bool belief = false;
    /** A pair that alone is less probable than this is rejected, whatever the belief. */
    double min_pair_probability = 0.1;
    double return_probability = 0.2;  ///< per frame: a camera on new ground returns
    double look_alike_share = 0.7;  ///< share of apparent returns that are look-alikes
    double leave_probability = 0.01;  ///< per frame: it leaves the known places again
    double jump_probability = 0.05;  ///< per frame: its next place is not near the last one
    /** A jump over more places of the earlier path than these may end at a look-alike, in
     *  look_alike_share of all cases. */
    int near_places = 40;
    /** Largest number of places moved along the earlier path per frame of a camera, forward or
     *  backward; frames of several cameras at one instant are one place. */
    int place_step = 3;
    /** Weight of a frame's evidence for or against a look-alike. Below 1, because look-alikes come
     *  in rows. */
    double look_alike_weight = 0.85;
    /** The verdict on a frame is given when the frames up to this many seconds of the recording
     *  later have been seen, and counts them, too: see PlaceSmoother. 0: at once. Needs the belief.
     *  */
    double look_ahead_seconds = 0;
    /** beta: verified frames of a camera in a row; the last is accepted. */
    int consecutive_frames = 2;
    /** Their candidates must follow one another within this many seconds of the recording, so that
     * a row cannot be made of different wrong places. 0: any candidates, as in the paper. */
    double max_candidate_step_seconds = 0;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
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
