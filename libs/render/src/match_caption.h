// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/render/match_picture.h"

#include <string>
#include <vector>

namespace fild
{
/** \throw std::invalid_argument when an image is empty or the verdict names no candidate. */
void check_match_picture(const MatchPicture& picture);

/** "query: frame 45", and when that was. */
std::vector<std::string> query_title(const MatchPicture& picture);
std::vector<std::string> candidate_title(const MatchPicture& picture);

/** What the numbers say. \param lines  between inliers, that are drawn. */
std::vector<std::string> match_caption(const MatchPicture& picture, std::size_t lines);

/** Height of letters in a picture so wide, pixels: legible in the smallest. */
double caption_height(int picture_width);

/** The parts joined into lines that fit the width, each at least one part. */
std::vector<std::string> wrapped(const std::vector<std::string>& parts,
                                 double letter_height,
                                 int width);

/** Height of a strip with such lines, pixels. */
int strip_height(std::size_t lines, double letter_height);

/** Writes lines into a strip, over what is drawn there, which fades. */
void draw_strip(cv::Mat& picture,
                const cv::Rect& strip,
                const std::vector<std::string>& lines,
                double letter_height);

/** Indices of so many pairs, or of all when they are fewer, that are as far from each other as can
 *  be in both images: farthest points first. */
std::vector<std::size_t> spread_pairs(const std::vector<PixelPair>& pairs, std::size_t count);

}  // namespace fild
