// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/camera_conversion.h"

#include <mrpt/img/TCamera.h>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
using mrpt::img::DistortionModel;

LensModel lens_from(DistortionModel model)
{
    switch (model)
    {
        case DistortionModel::plumb_bob:
            return LensModel::plumb_bob;
        case DistortionModel::kannala_brandt:
            return LensModel::kannala_brandt;
        default:
            return LensModel::none;
    }
}
}  // namespace

std::optional<CameraModel> camera_model_from(const mrpt::img::TCamera& camera)
{
    const auto is_finite = [](double number) { return std::isfinite(number); };
    const bool has_all_numbers = is_finite(camera.cx()) && is_finite(camera.cy()) &&
                                 std::all_of(camera.dist.begin(), camera.dist.end(), is_finite);
    if (!(camera.fx() > 0 && camera.fy() > 0) || !has_all_numbers) return std::nullopt;
    CameraModel model;
    model.fx = camera.fx();
    model.fy = camera.fy();
    model.cx = camera.cx();
    model.cy = camera.cy();
    model.width = static_cast<int>(camera.ncols);
    model.height = static_cast<int>(camera.nrows);
    model.lens = lens_from(camera.distortion);
    if (model.lens == LensModel::plumb_bob) model.distortion = camera.dist;
    // MRPT leaves a gap of two where plumb_bob has its tangential terms.
    if (model.lens == LensModel::kannala_brandt)
        model.distortion = {camera.k1(), camera.k2(), camera.k3(), camera.k4()};
    return model;
}

mrpt::img::TCamera mrpt_camera_from(const CameraModel& camera)
{
    mrpt::img::TCamera converted;
    converted.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    converted.ncols = static_cast<std::uint32_t>(camera.width);
    converted.nrows = static_cast<std::uint32_t>(camera.height);
    const auto& k = camera.distortion;
    if (camera.lens == LensModel::plumb_bob)
    {
        converted.distortion = DistortionModel::plumb_bob;
        converted.dist = k;
    }
    if (camera.lens == LensModel::kannala_brandt)
        converted.setDistortionKannalaBrandt(k[0], k[1], k[2], k[3]);
    return converted;
}

}  // namespace fild
