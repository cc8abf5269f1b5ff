// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/recording.h"

#include <string>
#include <vector>

namespace fild
{
/** \throw std::runtime_error when there is not one image in `others` for each in `images`. */
void check_equal_counts(std::size_t images,
                        const std::string& images_place,
                        std::size_t others,
                        const std::string& others_place);

/** \param way_out  what else than giving a calibration file the user can do.
 *  \throw std::runtime_error unless there is a calibration with a baseline. */
void check_stereo_calibration(const std::optional<Calibration>& calibration,
                              const std::string& way_out);

/** "2 left images without a right one" for 2 and "left image", "right one". */
std::string count_without(std::size_t count, const std::string& image, const std::string& partner);

}  // namespace fild
