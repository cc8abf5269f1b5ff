// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** From now on Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets a flag, so that results can be written;
 *  another one two seconds later or more ends the process as usual. Some callers, timeout(1) for
 * one, send a signal twice at once and mean it once. */
void catch_interruption();

/** True once the user has asked to stop. */
bool interrupted();

/** \throw std::runtime_error "interrupted" once the user has asked to stop. */
void throw_if_interrupted();

}  // namespace fild
