// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/features/local_feature_options.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace fild
{
/** Finds blobs in an image and describes each by 128 numbers: SURF-128, the extended descriptor of
 *  H. Bay, A. Ess, T. Tuytelaars, L. Van Gool, "Speeded-Up Robust Features", CVIU 110 (2008), which
 *  FILD (IROS 2019) section III-B uses to verify loops. Const members may run concurrently. */
class SurfExtractor
{
 public:
    /** \param num_threads  0: as many as the hardware has. The result does not depend on it.
     *  \throw std::invalid_argument for options out of range or a negative num_threads. */
    explicit SurfExtractor(const TLocalFeatureOptions& options, int num_threads = 1);

    /** The features of `image`, strongest determinant first (ties by y, x, size).
     *
     *  Keypoint::size is the side of the box mask at which the blob answered strongest, 7.5 times
     *  the scale s (the sigma of the Gaussian the mask stands for). Descriptors are the paper's
     * sums in this order: subregions row by row in the keypoint's frame, and in each sum dx, sum
     * |dx| where dy >= 0; the same where dy < 0; sum dy, sum |dy| where dx >= 0; the same where dx
     * < 0. All numbers are finite.
     *
     *  Closer to the border than half a mask nothing is found; wavelets that leave the image count
     *  as 0. Deterministic: the same bytes with any number of threads. Where the
     *  processor has AVX2 or AVX-512 it is used, to the bytes of the portable code.
     *  \param image  8 bit, 1 channel or 3 (BGR), of any size: too small or of one colour, it has
     * no features. \throw std::invalid_argument for an empty image or another pixel type. */
    LocalFeatures extract(const cv::Mat& image) const;

 private:
    TLocalFeatureOptions options_;
    int num_threads_;
};

/** Of SURF-128 descriptors, the same for every image, so that codes of different images compare.
 *  The deviations are 1: the paper's hashing divides by nothing.
 *
 *  The mean has the symmetry of the 4x4 grid: one set of numbers for the corner, the edge and the
 *  inner subregions each. In a set, |dx| exceeds |dy| and dx is not 0 but positive, because
 *  orientation assignment turns the strongest gradient onto the x axis; dy is 0. With `upright`
 *  descriptors the true means of |dx| and |dy| are alike (inner 0.165 and 0.13) and that of dx is
 *  0; the mean is then only common, not exact. */
DescriptorStatistics surf_statistics();

/** The same of rooted descriptors, whose numbers are replaced by their signed square roots, and
 *  these brought to unit norm. */
DescriptorStatistics rooted_surf_statistics();

}  // namespace fild
