// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/features/global_descriptor_options.h"
#include "fild/features/local_feature_options.h"
#include "fild/geometry/verification_options.h"
#include "fild/index/index_options.h"
#include "fild/matching/hashing_options.h"

#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** Section [consistency]: when verified frames in a row make a loop closure. */
struct TConsistencyOptions : Options
{
    int consecutive_frames = 2;  ///< beta: so many verified frames in a row, the last is accepted
    /** Their candidates must follow one another within this many seconds of the recording, so that
     * a row cannot be made of different wrong places. 0: any candidates, as in the paper. */
    double max_candidate_step_seconds = 0;
    /** A frame verified with at least so many inliers needs no row: the first frame of a return is
     *  found too. 0: every frame needs one, as in the paper. */
    int sure_inliers = 0;
    /** ... and only when they are at least this share of its keypoints. In an image full of texture
     *  one house that looks like another gives many inliers, yet few of all: 76 of 1,950 keypoints
     *  on the synthetic town, where true returns have 444 in the median. */
    double sure_inlier_share = 0;

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
    TVerificationOptions verification;
    TConsistencyOptions consistency;
    TRuntimeOptions runtime;

    /** The sections by name, in the order of the pipeline. */
    std::vector<std::pair<std::string, Options*>> sections();
};

}  // namespace fild
