// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
constexpr double kRadiansPerDegree = 0.017453292519943295;

}  // namespace fild
