// SPDX-License-Identifier: BSD-3-Clause
// Scale space and keypoint localisation: SURF (CVIU 2008) sections 3.3 and 3.4.
#include "hessian_maxima.h"

#include "box_hessian.h"
#include "fild/core/parallel_for.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace fild
{
namespace
{
/** Rows that one task of a thread works on: their determinants stay in its cache. */
constexpr int kRowsPerBand = 32;
constexpr float kWeaker = 10;  // how far the threshold is lowered for min_keypoints

/** Three neighbouring layers of an octave, around the middle one. */
class Neighbourhood
{
 public:
    explicit Neighbourhood(const HessianLayer* middle) : layers_{middle - 1, middle, middle + 1} {}

    float at(int dx, int dy, int dl, int column, int row) const
    {
        return layers_[dl + 1]->row(row + dy)[column + dx];
    }

    /** Of equal determinants the first in order of layer, row, column is the maximum: a blob that
     *  lies exactly between pixels is then found once, not twice and not never. */
    bool is_maximum(int column, int row) const
    {
        const float centre = at(0, 0, 0, column, row);
        for (int dl = -1; dl <= 1; ++dl)
            for (int dy = -1; dy <= 1; ++dy)
            {
                const float* near = layers_[dl + 1]->row(row + dy) + column;
                const int order = dl != 0 ? dl : dy;
                const bool before_fails = near[-1] > centre || (order <= 0 && near[-1] == centre);
                const bool after_fails = near[1] > centre || (order < 0 && near[1] == centre);
                const bool between_fails = near[0] > centre || (order < 0 && near[0] == centre);
                if (before_fails || after_fails || between_fails) return false;
            }
        return true;
    }

    /** Where the quadratic through the 27 determinants peaks, in grid steps (x, y, layer) from the
     *  centre (Brown and Lowe, BMVC 2002); nothing when that is further than one step. */
    std::optional<cv::Vec3d> peak_offset(int column, int row) const
    {
        const auto v = [&](int dx, int dy, int dl)
        { return static_cast<double>(at(dx, dy, dl, column, row)); };
        const double centre = v(0, 0, 0);
        const cv::Vec3d gradient((v(1, 0, 0) - v(-1, 0, 0)) / 2,
                                 (v(0, 1, 0) - v(0, -1, 0)) / 2,
                                 (v(0, 0, 1) - v(0, 0, -1)) / 2);
        const double xx = v(1, 0, 0) - 2 * centre + v(-1, 0, 0);
        const double yy = v(0, 1, 0) - 2 * centre + v(0, -1, 0);
        const double ll = v(0, 0, 1) - 2 * centre + v(0, 0, -1);
        const double xy = (v(1, 1, 0) - v(-1, 1, 0) - v(1, -1, 0) + v(-1, -1, 0)) / 4;
        const double xl = (v(1, 0, 1) - v(-1, 0, 1) - v(1, 0, -1) + v(-1, 0, -1)) / 4;
        const double yl = (v(0, 1, 1) - v(0, -1, 1) - v(0, 1, -1) + v(0, -1, -1)) / 4;
        const cv::Matx33d curvature(xx, xy, xl, xy, yy, yl, xl, yl, ll);
        bool invertible = false;
        const cv::Vec3d offset = -(curvature.inv(cv::DECOMP_LU, &invertible) * gradient);
        if (!invertible || !(cv::norm(offset, cv::NORM_INF) <= 1.0)) return std::nullopt;
        return offset;
    }

 private:
    const HessianLayer* layers_[3];
};

Keypoint make_keypoint(const HessianLayer* middle, int column, int row, const cv::Vec3d& offset)
{
    const auto& layer = *middle;
    const int mask_step = (middle + 1)->mask.size() - layer.mask.size();
    Keypoint keypoint;
    keypoint.x = static_cast<float>((column + offset[0]) * layer.step);
    keypoint.y = static_cast<float>((row + offset[1]) * layer.step);
    keypoint.size = static_cast<float>(layer.mask.size() + offset[2] * mask_step);
    keypoint.response = layer.row(row)[column];
    return keypoint;
}

/** What all bands are searched with. */
struct Search
{
    const IntegralImage& integral;
    const TLocalFeatureOptions& options;
    float threshold;
    const SurfKernels& kernels;
};

/** The part of an octave that is searched at a time, [first_row, last_row). */
struct Band
{
    int octave = 0;
    int first_row = 0;
    int last_row = 0;
};

std::vector<Band> bands_of(const IntegralImage& integral, int octaves)
{
    std::vector<Band> bands;
    for (int octave = 0; octave < octaves; ++octave)
    {
        const int rows = ceil_divide(integral.height(), 1 << octave);
        for (int row = 0; row < rows; row += kRowsPerBand)
            bands.push_back({octave, row, std::min(row + kRowsPerBand, rows)});
    }
    return bands;
}

/** Appends the maxima in the band's rows of `middle`, which has a layer on either side in memory.
 *  Only where the larger mask fits at all neighbours: else there is nothing to compare with. */
void append_maxima(const Search& search,
                   const Band& band,
                   const HessianLayer* middle,
                   std::vector<Keypoint>& maxima)
{
    const Neighbourhood neighbourhood(middle);
    const int margin = ceil_divide((middle + 1)->mask.reach(), middle->step) + 1;
    const int last_row = std::min(band.last_row, middle->rows - margin);
    const ColumnRange inside{margin, middle->columns - margin};
    std::vector<int> columns;
    for (int row = std::max(band.first_row, margin); row < last_row; ++row)
    {
        columns.clear();
        search.kernels.append_peaks(*middle, row, inside, search.threshold, columns);
        for (const int column : columns)
        {
            if (!neighbourhood.is_maximum(column, row)) continue;
            const auto offset = neighbourhood.peak_offset(column, row);
            if (offset) maxima.push_back(make_keypoint(middle, column, row, *offset));
        }
    }
}

/** The layers to look for maxima in: those between two others whose mask no finer octave has. */
std::vector<std::size_t> middle_layers(int octave, int layers_per_octave)
{
    const int largest = octave == 0 ? 0 : mask_of(octave - 1, layers_per_octave).size();
    std::vector<std::size_t> middles;
    for (int layer = 1; layer <= layers_per_octave; ++layer)
        if (mask_of(octave, layer).size() > largest)
            middles.push_back(static_cast<std::size_t>(layer));
    return middles;
}

/** Computes the determinants of the band, and of a row above and below, and finds their maxima. */
std::vector<Keypoint> maxima_in_band(const Search& search, const Band& band)
{
    const int layers_per_octave = search.options.layers_per_octave;
    const int first_row = band.first_row - 1;
    const int last_row = band.last_row + 1;
    std::vector<HessianLayer> layers;
    for (int i = 0; i < layers_per_octave + 2; ++i)
    {
        auto& layer = layers.emplace_back(
            search.integral, mask_of(band.octave, i), 1 << band.octave, first_row, last_row);
        search.kernels.fill(
            search.integral, layer, layer.first_row, std::min(last_row, layer.rows));
    }
    std::vector<Keypoint> maxima;
    for (const auto middle : middle_layers(band.octave, layers_per_octave))
        append_maxima(search, band, &layers[middle], maxima);
    return maxima;
}

bool is_stronger(const Keypoint& a, const Keypoint& b)
{
    return std::make_tuple(-a.response, a.y, a.x, a.size) <
           std::make_tuple(-b.response, b.y, b.x, b.size);
}

/** Maxima of the determinant above the threshold in all layers, strongest first. */
std::vector<Keypoint> all_maxima(const Search& search, int num_threads)
{
    const auto bands = bands_of(search.integral, search.options.octaves);
    std::vector<std::vector<Keypoint>> found(bands.size());
    parallel_for(num_threads,
                 bands.size(),
                 [&](std::size_t i) { found[i] = maxima_in_band(search, bands[i]); });
    std::vector<Keypoint> keypoints;
    for (const auto& band : found) keypoints.insert(keypoints.end(), band.begin(), band.end());
    std::sort(keypoints.begin(), keypoints.end(), is_stronger);
    return keypoints;
}
}  // namespace

BoxMask mask_of(int octave, int layer)
{
    return BoxMask{(2 << octave) * (layer + 1) + 1};
}

std::vector<Keypoint> find_hessian_maxima(const IntegralImage& integral,
                                          const TLocalFeatureOptions& options,
                                          int num_threads,
                                          const SurfKernels& kernels)
{
    const auto threshold = static_cast<float>(options.hessian_threshold);
    auto keypoints = all_maxima({integral, options, threshold, kernels}, num_threads);
    const auto wanted = static_cast<std::size_t>(options.min_keypoints);
    if (keypoints.size() < wanted)
    {
        keypoints = all_maxima({integral, options, threshold / kWeaker, kernels}, num_threads);
        if (keypoints.size() > wanted) keypoints.resize(wanted);
    }
    const auto limit = static_cast<std::size_t>(options.max_keypoints);
    if (limit > 0 && keypoints.size() > limit) keypoints.resize(limit);
    return keypoints;
}

}  // namespace fild
