// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationStereoImages.h>

namespace fild
{
/** The images of two cameras, which have a time stamp each. To MRPT, in a file too, they are
 *  CObservationStereoImages: the right one's time is lost there. */
class CPairedImages : public mrpt::obs::CObservationStereoImages
{
 public:
    double right_seconds_later = 0;  ///< than the left image
};

}  // namespace fild
