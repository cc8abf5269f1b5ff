// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** To be called before anything is opened or printed. Standard descriptors that are closed lead to
 *  /dev/null from now on: no result file takes their number and receives what is printed. A write
 *  to a closed pipe, or beyond a limit of file sizes, fails from now on and does not end the
 *  process. */
void prepare_standard_streams();

/** Flushes std::cout. A reader that has closed its pipe has seen what it wanted: no error.
 *  \throw std::runtime_error when what was printed did not reach a file (disk full). */
void require_printed();

}  // namespace fild
