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
using Octave = std::vector<HessianLayer>;

/** Rows that one task of a thread works on. */
constexpr int kRowsPerBand = 32;
constexpr float kWeaker = 10;  // how far the threshold is lowered for min_keypoints

/** Masks of octave o grow by 6 * 2^o pixels: 9 15 21 27, then 15 27 39 51, 27 51 75 99, ... */
BoxMask mask_of(int octave, int layer)
{
    return BoxMask{(2 << octave) * (layer + 1) + 1};
}

/** Calls body(layer, first_row, last_row) for all bands of rows of `layers`, in parallel. */
template <class Layer, class Body>
void for_each_band(int num_threads, const std::vector<Layer*>& layers, const Body& body)
{
    struct Band
    {
        Layer* layer;
        int first_row;
    };
    std::vector<Band> bands;
    for (auto* layer : layers)
        for (int row = 0; row < layer->rows; row += kRowsPerBand) bands.push_back({layer, row});
    parallel_for(num_threads,
                 bands.size(),
                 [&](std::size_t i)
                 {
                     const auto& band = bands[i];
                     body(*band.layer,
                          band.first_row,
                          std::min(band.first_row + kRowsPerBand, band.layer->rows));
                 });
}

std::vector<Octave> build_pyramid(const IntegralImage& integral,
                                  const TLocalFeatureOptions& options,
                                  int num_threads)
{
    std::vector<Octave> pyramid(static_cast<std::size_t>(options.octaves));
    std::vector<HessianLayer*> layers;
    for (int o = 0; o < options.octaves; ++o)
    {
        auto& octave = pyramid[static_cast<std::size_t>(o)];
        for (int i = 0; i < options.layers_per_octave + 2; ++i)
            octave.emplace_back(integral, mask_of(o, i), 1 << o);
        for (auto& layer : octave) layers.push_back(&layer);
    }
    for_each_band(num_threads,
                  layers,
                  [&](HessianLayer& layer, int first_row, int last_row)
                  { fill_determinants(integral, layer, first_row, last_row); });
    return pyramid;
}

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

/** Maxima in rows [first_row, last_row) of `middle`, which has a layer on either side in memory.
 *  Only where the larger mask fits at all neighbours: else there is nothing to compare with. */
std::vector<Keypoint> maxima_in_band(const HessianLayer* middle,
                                     float threshold,
                                     int first_row,
                                     int last_row)
{
    const Neighbourhood neighbourhood(middle);
    const int reach = (middle + 1)->mask.reach();
    const int margin = (reach + middle->step - 1) / middle->step + 1;
    std::vector<Keypoint> found;
    for (int row = std::max(first_row, margin); row < std::min(last_row, middle->rows - margin);
         ++row)
        for (int column = margin; column < middle->columns - margin; ++column)
        {
            if (!(middle->row(row)[column] > threshold)) continue;
            if (!neighbourhood.is_maximum(column, row)) continue;
            const auto offset = neighbourhood.peak_offset(column, row);
            if (offset) found.push_back(make_keypoint(middle, column, row, *offset));
        }
    return found;
}

/** The layers to look for maxima in: those between two others whose mask no finer octave has. */
std::vector<const HessianLayer*> middle_layers(const std::vector<Octave>& pyramid)
{
    std::vector<const HessianLayer*> middles;
    int largest = 0;
    for (const auto& octave : pyramid)
        for (std::size_t i = 1; i + 1 < octave.size(); ++i)
            if (octave[i].mask.size() > largest)
            {
                largest = octave[i].mask.size();
                middles.push_back(&octave[i]);
            }
    return middles;
}

bool is_stronger(const Keypoint& a, const Keypoint& b)
{
    return std::make_tuple(-a.response, a.y, a.x, a.size) <
           std::make_tuple(-b.response, b.y, b.x, b.size);
}
/** Maxima of the determinant above the threshold in all layers, strongest first. */
std::vector<Keypoint> maxima_above(float threshold,
                                   const std::vector<Octave>& pyramid,
                                   int num_threads)
{
    std::vector<Keypoint> keypoints;
    for (const auto* middle : middle_layers(pyramid))
    {
        const auto bands =
            static_cast<std::size_t>((middle->rows + kRowsPerBand - 1) / kRowsPerBand);
        std::vector<std::vector<Keypoint>> found(bands);
        for_each_band<const HessianLayer>(
            num_threads,
            {middle},
            [&](const HessianLayer&, int first_row, int last_row)
            {
                found[static_cast<std::size_t>(first_row / kRowsPerBand)] =
                    maxima_in_band(middle, threshold, first_row, last_row);
            });
        for (const auto& band : found) keypoints.insert(keypoints.end(), band.begin(), band.end());
    }
    std::sort(keypoints.begin(), keypoints.end(), is_stronger);
    return keypoints;
}
}  // namespace

std::vector<Keypoint> find_hessian_maxima(const IntegralImage& integral,
                                          const TLocalFeatureOptions& options,
                                          int num_threads)
{
    const auto pyramid = build_pyramid(integral, options, num_threads);
    const auto threshold = static_cast<float>(options.hessian_threshold);
    auto keypoints = maxima_above(threshold, pyramid, num_threads);
    const auto wanted = static_cast<std::size_t>(options.min_keypoints);
    if (keypoints.size() < wanted)
    {
        keypoints = maxima_above(threshold / kWeaker, pyramid, num_threads);
        if (keypoints.size() > wanted) keypoints.resize(wanted);
    }
    const auto limit = static_cast<std::size_t>(options.max_keypoints);
    if (limit > 0 && keypoints.size() > limit) keypoints.resize(limit);
    return keypoints;
}

}  // namespace fild
