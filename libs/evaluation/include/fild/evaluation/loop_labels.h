// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** Labelled loops: which earlier frames show the place of a frame. Frames are numbered from 0.
 *
 *  Published loop matrices have row = query and column = earlier frame, so that all entries lie
 *  below the diagonal. What does not is treated alike in matrices and lists:
 *  - Most entries above the diagonal: it is stored the other way round; rows and columns are
 *    swapped.
 *  - An entry above the diagonal whose mirror image is there too repeats it: ignored.
 *  - Any other entry above the diagonal is a label error, as no frame closes a loop with a later
 *    one. The entry is dropped, but its query remains: published counts of loop queries are counts
 *    of rows with an entry. Such a query can never be answered.
 *  - An entry on the diagonal says that a frame shows its own place: ignored. */
struct LoopLabels
{
    /** For each loop query its true earlier frames, ascending, perhaps none. */
    std::map<std::size_t, std::vector<std::size_t>> earlier_frames;
    /** Pairs of a query and an earlier frame that are labelled as neither loops nor none;
     *  in a list the later frame is the query, in whichever order it stands. */
    std::set<std::pair<std::size_t, std::size_t>> doubtful;
    std::optional<std::size_t> frames;  ///< that were labelled; none: not known (a list)
    bool transposed = false;
    std::size_t pairs = 0;  ///< of a query and a true earlier frame
    std::size_t dropped = 0;  ///< label errors
    std::size_t mirrored = 0;
    std::size_t on_diagonal = 0;

    /** Loop queries without a true earlier frame. */
    std::size_t unanswerable_queries() const;
};

/** Sorts out labelled (query, earlier frame) pairs as LoopLabels says; repeated pairs count once.
 */
LoopLabels to_loop_labels(std::vector<std::pair<std::size_t, std::size_t>> pairs,
                          std::optional<std::size_t> frames);

/** Reads a list, `QUERY CANDIDATE` a line, frame numbers from 0, separated by blanks, or with a
 *  third word 0 for a doubtful pair; blank lines and lines that begin with `#` are passed over.
 *  \throw std::runtime_error naming file and line. */
LoopLabels read_loop_list(const std::string& path);

/** Reads a loop matrix out of a MATLAB file (version 4, 5 or 7.3): its only square matrix of real
 *  numbers of any class, logical included, full or sparse; other variables, vectors and scalars
 *  are passed over. Any number but 0 is an entry.
 *  \throw std::runtime_error when the file cannot be read or is cut off, there is no such matrix or
 * more than one (naming those that are there), it is not square, or a cell is not a number. */
LoopLabels read_loop_matrix(const std::string& path);

}  // namespace fild
