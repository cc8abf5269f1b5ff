// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/detector_options.h"

#include <limits>
#include <stdexcept>

namespace fild
{
void TCandidateOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("best_by_cells", best_by_cells, 0, 1000);
    visitor.integer("place_frames", place_frames, 0, 1000);
    visitor.integer("neighbour_reach", neighbour_reach, 0, 1000);
    visitor.flag("follow_belief", follow_belief);
    visitor.flag("stop_at_first", stop_at_first);
}

void TConsistencyOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("belief", belief);
    visitor.real("min_pair_probability", min_pair_probability, 0.000001, 0.999999);
    visitor.real("return_probability", return_probability, 1e-6, 0.9);
    visitor.real("look_alike_share", look_alike_share, 0, 0.99);
    visitor.real("leave_probability", leave_probability, 1e-6, 0.5);
    visitor.real("jump_probability", jump_probability, 1e-6, 0.49);
    visitor.integer("near_places", near_places, 0, 100000);
    visitor.integer("place_step", place_step, 0, 1000);
    visitor.real("look_alike_weight", look_alike_weight, 0, 1);
    visitor.real("look_ahead_seconds", look_ahead_seconds, 0, 3600);
    visitor.integer("consecutive_frames", consecutive_frames, 1, 1000);
    visitor.real("max_candidate_step_seconds", max_candidate_step_seconds, 0, 1e6);
}

void TConsistencyOptions::check_between_fields() const
{
    if (look_ahead_seconds > 0 && !belief)
        throw std::invalid_argument("look_ahead_seconds > 0 needs belief = true");
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
            {"same_place", &same_place},
            {"consistency", &consistency},
            {"depth", &depth},
            {"relative_pose", &relative_pose},
            {"runtime", &runtime}};
}

void TDetectorOptions::check_between_sections() const
{
    if (consistency.belief && !same_place.enabled)
        throw std::invalid_argument(
            "[consistency] belief = true needs the evidence of [same_place] enabled = true");
    if (candidates.best_by_cells > 0 && global_descriptor.cell_layer.empty())
        throw std::invalid_argument(
            "[candidates] best_by_cells > 0 needs a layer in [global_descriptor] cell_layer");
    if (hashing.search == CodeSearch::guided && global_descriptor.cell_layer.empty())
        throw std::invalid_argument(
            "[hashing] search = guided needs a layer in [global_descriptor] cell_layer");
    if (candidates.follow_belief && !consistency.belief)
        throw std::invalid_argument(
            "[candidates] follow_belief = true needs [consistency] belief = true");
}

}  // namespace fild
