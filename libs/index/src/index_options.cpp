// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/index_options.h"

namespace fild
{
void TIndexOptions::describe(OptionVisitor& visitor)
{
    visitor.real("delay_seconds", delay_seconds, 0, 1e6);
    visitor.real("frame_rate", frame_rate, 0, 1e4);
    visitor.real("still_seconds", still_seconds, 0, 1e6);
    visitor.integer("candidates", candidates, 1, 1000);
    visitor.real("min_similarity", min_similarity, -1, 1);
    visitor.integer("whiten_from", whiten_from, 0, 1000000);
    visitor.real("whitening_shrinkage", whitening_shrinkage, 1e-3, 1e6);
    visitor.choice<IndexBackend>(
        "backend", backend, {{"hnsw", IndexBackend::hnsw}, {"exact", IndexBackend::exact}});
    visitor.integer("links_per_node", links_per_node, 2, 200);
    visitor.integer("construction_width", construction_width, 1, 10000);
    visitor.integer("search_width", search_width, 1, 10000);
}

void TIndexOptions::check_between_fields() const
{
    if (backend == IndexBackend::hnsw && search_width < candidates)
        throw std::invalid_argument("search_width=" + std::to_string(search_width) +
                                    " is below candidates=" + std::to_string(candidates));
}

}  // namespace fild
