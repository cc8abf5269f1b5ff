// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/render/picture_view.h"
#include "map_content.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace fild
{
/** Draws what the lines mean, right of the plot. */
void draw_legend(cv::Mat& picture, const MapContent& map, const std::string& title);

/** Frames and length of the optimised path, and the length of the true one if that is known. */
std::vector<std::string> lengths_of(const MapContent& map);

/** What the largest label of the grid takes, its distance from the grid included, pixels. */
cv::Size label_size(const MapContent& map);

/** Labels the grid's lines where they end, in metres, and the marks of start and end.
 *  \param view  of the moved map. */
void draw_labels(cv::Mat& picture, const MapContent& map, const PictureView& view);

}  // namespace fild
