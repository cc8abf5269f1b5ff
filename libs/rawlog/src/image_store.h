// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>

namespace mrpt::img
{
class CImage;
}

namespace fild
{
/** Gets at the pixels of an observation's image, wherever they are. Does not touch MRPT's
 *  process-wide folder of images (CImage::setImagesPathBase). Const members may run concurrently.
 */
class ImageStore
{
 public:
    /** \param images_dir  folder of external images; empty: the one MRPT would use for the rawlog,
     *  which need not exist as long as no image is looked for.
     *  \param max_megabytes  of an external image, see read_image_file(). */
    ImageStore(const std::string& images_dir, const std::string& rawlog_path, int max_megabytes);

    /** Path of an externally stored image; empty for an embedded one. */
    std::string path_of(const mrpt::img::CImage& image) const;

    /** Path of a file that the rawlog names. If there is no such file, the first that exists of:
     *  the same name with its ending in small or in capital letters; for a path from another
     *  computer, the last parts of that path in the folder of images. */
    std::string path_of_file(const std::string& name) const;

    /** The pixels as stored, shared with `image` when embedded. Nothing when there are none. */
    std::optional<cv::Mat> load(const mrpt::img::CImage& image) const;

 private:
    std::string images_dir_;
    int max_megabytes_;
};

/** 8-bit grey as it is, 8-bit colour without alpha. 16 bits become 8: all but the darkest and the
 *  brightest thousandth of the numbers are spread over 0 to 255, but never wider than they are.
 *  Nothing for all other kinds of pixels. */
std::optional<cv::Mat> as_grey_or_bgr(const cv::Mat& image);

/** "32 bit floating point, 1 channel" */
std::string describe_pixels(const cv::Mat& image);

}  // namespace fild
