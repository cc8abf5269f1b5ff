// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/features/global_descriptor_options.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace fild
{
/** A layer's output as channels x rows x columns of floats; a vector of C numbers is C x 1 x 1. */
struct FeatureMap
{
    const float* data;
    int channels;
    int rows;
    int columns;
};

/** \throw std::runtime_error when the blob is no single image's output. */
FeatureMap to_feature_map(const cv::Mat& blob);

/** The map as one vector, of unit norm (all zero when the map is): `channels` numbers, with grid
 *  pooling cells x channels, cell by cell, row by row.
 *  \throw std::runtime_error when the grid is finer than the map. */
std::vector<float> pool(const FeatureMap& map, const TGlobalDescriptorOptions& options);

/** The map cell by cell, each channel with mean 0 and deviation 1; one that does not vary is 0. */
CellFeatures to_cells(const FeatureMap& map);

/** Scales the numbers in [first, last) to unit norm; leaves zeros alone. */
void normalize(std::vector<float>::iterator first, std::vector<float>::iterator last);

}  // namespace fild
