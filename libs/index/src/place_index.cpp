// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/place_index.h"

#include "fild/index/exact_index.h"
#include "fild/index/hnsw_index.h"
#include "fild/index/whitened_index.h"

namespace fild
{
std::unique_ptr<PlaceIndex> make_place_index(const TIndexOptions& options,
                                             std::size_t dimension,
                                             std::uint64_t seed)
{
    options.check();
    const auto make = [options, dimension, seed]() -> std::unique_ptr<PlaceIndex>
    {
        if (options.backend == IndexBackend::exact) return std::make_unique<ExactIndex>(dimension);
        return std::make_unique<HnswIndex>(options, dimension, seed);
    };
    if (options.whiten_from > 0) return std::make_unique<WhitenedIndex>(options, make);
    return make();
}

}  // namespace fild
