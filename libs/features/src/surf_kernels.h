// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_hessian.h"
#include "orientation.h"
#include "row_peaks.h"
#include "surf_descriptor.h"

#include <vector>

namespace fild
{
/** The parts of SURF that take most of its time, for one kind of processor. On one processor all
 *  kinds give the same bits: they compute side by side only what does not depend on one another,
 *  and each number as the portable function does, without fused multiply-adds. Other processors may
 *  differ in the last bits of the C library's sine, cosine and arc tangent. */
struct SurfKernels
{
    const char* processor;  ///< its name
    decltype(&fill_determinants) fill;
    decltype(&append_row_peaks) append_peaks;
    decltype(&dominant_orientation) orient;
    decltype(&surf_descriptor) describe;
};

/** For any processor. */
SurfKernels portable_surf_kernels();

/** What this processor can run: the portable ones first, the fastest last. */
std::vector<SurfKernels> surf_kernels();

}  // namespace fild
