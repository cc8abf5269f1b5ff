// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** An image file. Value type. */
struct ImageFile
{
    std::string path;
    std::string origin;  ///< "list.txt line 12", or the path: named in errors
};

/** One image of a list or folder. Value type. */
struct ListedImage : ImageFile
{
    std::optional<double> seconds;  ///< from the list's second column
};

/** An image and when it was taken. Value type. */
struct StampedImage : ImageFile
{
    double seconds = 0;  ///< since the UNIX epoch, or since any start
};

/** Where time stamps come from, beside the list's second column. */
struct TimestampSource
{
    std::string file;  ///< one number of seconds a line; empty: none
    std::optional<double> rate_hz;  ///< evenly spaced from 0
};

/** The images (.png .jpg .jpeg .pgm .ppm .pnm .bmp .tif .tiff, in either case) of a folder, without
 *  its subfolders and hidden files, by name: whole numbers by their value (img2 stands before
 *  img10), all else in the order of bytes.
 *  \throw std::runtime_error when there is no such folder or no image in it. */
std::vector<ListedImage> list_image_folder(const std::string& folder);

/** Reads a list of images: one a line, absolute or relative to the folder of the list. When the
 *  last of several words of a line is a number, it is the time in seconds and the name is what
 *  stands before it; else the whole line is the name, blanks included. Blank lines and lines that
 *  begin with `#` are passed over. The images are not looked at.
 *  \throw std::runtime_error naming file and line: unreadable, empty, or a time in some lines only.
 */
std::vector<ListedImage> read_image_list(const std::string& path);

/** Gives each image its time, from the only source there is.
 *  \throw std::invalid_argument when there is no source or more than one, or the rate is outside
 *         (0, 1e6] Hz.
 *  \throw std::runtime_error when the counts of images and times differ, on a line that is no
 *         number, times outside [0, 1e10) s, or times that do not grow by at least 1e-6 s (naming
 *         both places). */
std::vector<StampedImage> stamp_images(const std::vector<ListedImage>& images,
                                       const TimestampSource& source);

}  // namespace fild
