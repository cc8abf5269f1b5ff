// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace fild
{
/** Called often during long work. An exception that it throws ends the work and reaches the caller.
 *  The default never cancels. */
using CheckCancelled = std::function<void()>;

/** For work that nobody cancels. */
inline void never_cancelled() {}

}  // namespace fild
