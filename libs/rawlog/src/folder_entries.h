// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace fild
{
/** Paths of the images of a folder, without its subfolders and hidden files; may be none. In the
 *  order of names, whole numbers by their value (img2 before img10), all else by bytes.
 *  \throw std::runtime_error when there is no such folder. */
std::vector<std::string> image_paths_in(const std::string& folder);

/** For an error message, what a folder holds instead of what was looked for: " (it holds NAME, for
 *  example)" or " (it is empty)". */
std::string example_in(const std::string& folder);

}  // namespace fild
