// SPDX-License-Identifier: BSD-3-Clause
#include "image_pairs.h"

#include "fild/core/words.h"

#include <stdexcept>

namespace fild
{
void check_equal_counts(std::size_t images,
                        const std::string& images_place,
                        std::size_t others,
                        const std::string& others_place)
{
    if (images != others)
        throw std::runtime_error(count_of(images, "image") + " in " + images_place + ", " +
                                 std::to_string(others) + " in " + others_place +
                                 "; they are paired by order, so there must be one for each");
}

void check_stereo_calibration(const std::optional<Calibration>& calibration,
                              const std::string& way_out)
{
    if (!calibration)
        throw std::runtime_error(
            "stereo images need a calibration: give --calib FILE with the lines "
            "'fx fy cx cy width height' and 'baseline METRES', or " +
            way_out);
    if (!calibration->left_from_right())
        throw std::runtime_error(
            "stereo images need a baseline: add the last line 'baseline METRES' or 'right_pose "
            "...' "
            "to the calibration file, or " +
            way_out);
}

std::string count_without(std::size_t count, const std::string& image, const std::string& partner)
{
    return std::to_string(count) + " " + image + (count == 1 ? "" : "s") + " without a " + partner;
}

}  // namespace fild
