// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/detector_options.h"

#include <limits>

namespace fild
{
void TCandidateOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("place_frames", place_frames, 0, 1000);
    visitor.integer("neighbour_reach", neighbour_reach, 0, 1000);
    visitor.integer("place_memory", place_memory, 0, 1000000);
    visitor.flag("stop_at_first", stop_at_first);
}

void TConsistencyOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("consecutive_frames", consecutive_frames, 1, 1000);
    visitor.real("max_candidate_step_seconds", max_candidate_step_seconds, 0, 1e6);
}

void TRuntimeOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("seed", seed, 0, std::numeric_limits<int>::max());
    visitor.integer("num_threads", num_threads, 0, 256);
}

std::vector<std::pair<std::string, Options*>> TDetectorOptions::sections()
{
    return {{"global_descriptor", &global_descriptor},
            {"index", &index},
            {"local_features", &local_features},
            {"hashing", &hashing},
            {"candidates", &candidates},
            {"verification", &verification},
            {"consistency", &consistency},
            {"depth", &depth},
            {"relative_pose", &relative_pose},
            {"runtime", &runtime}};
}

}  // namespace fild
