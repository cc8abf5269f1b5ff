// SPDX-License-Identifier: BSD-3-Clause
#include "pooling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
/** A block of rows [top, bottom) and columns [left, right). */
struct Cell
{
    int top;
    int bottom;
    int left;
    int right;
};

/** Generalised mean of one channel over a cell; power 1 is the plain mean. Negative activations
 *  count as 0 when the power is not 1 (Radenovic et al., PAMI 2019, Eq. 3). */
float generalised_mean(const FeatureMap& map, int channel, const Cell& cell, double power)
{
    double sum = 0;
    for (int y = cell.top; y < cell.bottom; ++y)
    {
        const float* row = map.data + std::ptrdiff_t{channel * map.rows + y} * map.columns;
        for (int x = cell.left; x < cell.right; ++x)
            sum += power == 1 ? row[x] : std::pow(std::max(0.0F, row[x]), power);
    }
    const double mean = sum / ((cell.bottom - cell.top) * (cell.right - cell.left));
    return static_cast<float>(power == 1 ? mean : std::pow(mean, 1 / power));
}

std::pair<double, double> mean_and_deviation(const float* values, std::size_t count)
{
    const auto n = static_cast<double>(count);
    const double mean = std::accumulate(values, values + count, 0.0) / n;
    const auto add_square = [mean](double sum, float x) { return sum + (x - mean) * (x - mean); };
    return {mean, std::sqrt(std::accumulate(values, values + count, 0.0, add_square) / n)};
}

std::vector<float> pool_cells(const FeatureMap& map, int rows, int columns, double power)
{
    if (rows > map.rows || columns > map.columns)
        throw std::runtime_error("[global_descriptor] a grid of " + std::to_string(rows) + "x" +
                                 std::to_string(columns) + " is finer than the layer's map of " +
                                 std::to_string(map.rows) + "x" + std::to_string(map.columns));
    std::vector<float> pooled;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
        {
            const Cell cell{i * map.rows / rows,
                            (i + 1) * map.rows / rows,
                            j * map.columns / columns,
                            (j + 1) * map.columns / columns};
            for (int channel = 0; channel < map.channels; ++channel)
                pooled.push_back(generalised_mean(map, channel, cell, power));
            normalize(pooled.end() - map.channels, pooled.end());
        }
    return pooled;
}
}  // namespace

FeatureMap to_feature_map(const cv::Mat& blob)
{
    if (blob.depth() == CV_32F && blob.isContinuous() && blob.dims >= 2 && blob.size[0] == 1)
    {
        const auto* data = blob.ptr<float>();
        if (blob.dims == 4) return {data, blob.size[1], blob.size[2], blob.size[3]};
        if (blob.dims == 2) return {data, blob.size[1], 1, 1};
    }
    throw std::runtime_error("the network's output is neither 1 x C x H x W nor 1 x C floats");
}

void normalize(std::vector<float>::iterator first, std::vector<float>::iterator last)
{
    double squares = 0;
    std::for_each(first, last, [&](float x) { squares += static_cast<double>(x) * x; });
    if (squares == 0) return;
    const double norm = std::sqrt(squares);
    std::for_each(first, last, [&](float& x) { x = static_cast<float>(x / norm); });
}

CellFeatures to_cells(const FeatureMap& map)
{
    CellFeatures cells{map.rows, map.columns, map.channels, {}};
    const auto channels = static_cast<std::size_t>(map.channels);
    cells.values.resize(cells.size() * channels);
    for (std::size_t c = 0; c < channels; ++c)
    {
        const float* values = map.data + c * cells.size();
        const auto [mean, deviation] = mean_and_deviation(values, cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i)
            cells.values[i * channels + c] =
                deviation > 0 ? static_cast<float>((values[i] - mean) / deviation) : 0;
    }
    return cells;
}

std::vector<float> pool(const FeatureMap& map, const TGlobalDescriptorOptions& options)
{
    std::vector<float> pooled;
    switch (options.pooling)
    {
        case Pooling::average:
            pooled = pool_cells(map, 1, 1, 1);
            break;
        case Pooling::gem:
            pooled = pool_cells(map, 1, 1, options.gem_power);
            break;
        case Pooling::grid:
            pooled = pool_cells(map, options.grid_rows, options.grid_columns, 1);
            break;
    }
    normalize(pooled.begin(), pooled.end());
    return pooled;
}

}  // namespace fild
