// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>

namespace mrpt::obs
{
class CObservation3DRangeScan;
}

namespace fild
{
/** What a range scan measured, float, metres, 0 where it has no reading; empty when it has no range
 *  image or an external one that cannot be read. \param external_path  of its file, where the image
 *  is stored in one, as MRPT writes them: binary, gzipped or not, or a text file. */
cv::Mat ranges_of(const mrpt::obs::CObservation3DRangeScan& scan, const std::string& external_path);

}  // namespace fild
