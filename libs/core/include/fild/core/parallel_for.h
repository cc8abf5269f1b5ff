// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace fild
{
/** Calls body(i) for every i in [0, count), spread over up to `num_threads` threads (0: as many as
 *  the hardware has; 1: this thread alone, in order).
 *
 *  The body must write its result to a place of its own, chosen by i: then the outcome does not
 *  depend on the number of threads. The first exception of a body, by index, is rethrown here after
 *  all threads have ended. Thread-safe. */
void parallel_for(int num_threads, std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace fild
