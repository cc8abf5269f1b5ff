// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace fild
{
/** The user has asked to stop. */
class Interrupted : public std::runtime_error
{
 public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/** From now on Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets a flag, so that results can be written;
 *  another one two seconds later or more ends the process as usual. Some callers, timeout(1) for
 *  one, send a signal twice at once and mean it once. A SIGHUP that is ignored already, as nohup(1)
 *  has it, stays ignored. */
void catch_interruption();

/** True once the user has asked to stop. */
bool interrupted();

/** \throw Interrupted once the user has asked to stop. */
void throw_if_interrupted();

}  // namespace fild
