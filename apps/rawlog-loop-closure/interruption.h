// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** From now on the first Ctrl-C (SIGINT) or SIGTERM only sets a flag, so that results can be
 * written; the second ends the process as usual. */
void catch_interruption();

/** True once the user has asked to stop. */
bool interrupted();

}  // namespace fild
