// SPDX-License-Identifier: BSD-3-Clause
#include "surf_kernels.h"

#ifdef __x86_64__
#include "wide_descriptor.h"
#include "wide_hessian.h"
#include "wide_orientation.h"
#include "wide_peaks.h"
#endif

namespace fild
{
#ifdef __x86_64__
namespace
{
/** The wide functions for one kind of processor. A macro, because attributes cannot be template
 *  arguments. */
#define FILD_WIDE_SURF(name, lanes, instructions)                                                 \
    struct name                                                                                   \
    {                                                                                             \
        __attribute__((target(instructions))) static void fill(const IntegralImage& integral,     \
                                                               HessianLayer& layer,               \
                                                               int first_row,                     \
                                                               int last_row)                      \
        {                                                                                         \
            fill_determinants_in_lanes<lanes>(integral, layer, first_row, last_row);              \
        }                                                                                         \
        __attribute__((target(instructions))) static void append_peaks(const HessianLayer& layer, \
                                                                       int row,                   \
                                                                       ColumnRange range,         \
                                                                       float threshold,           \
                                                                       std::vector<int>& columns) \
        {                                                                                         \
            append_row_peaks_in_lanes<8>(layer, row, range, threshold, columns);                  \
        }                                                                                         \
        __attribute__((target(instructions))) static float orient(const IntegralImage& integral,  \
                                                                  const Keypoint& keypoint)       \
        {                                                                                         \
            return dominant_orientation_in_lanes<lanes>(integral, keypoint);                      \
        }                                                                                         \
        __attribute__((target(instructions))) static SurfDescriptor describe(                     \
            const IntegralImage& integral, const Keypoint& keypoint)                              \
        {                                                                                         \
            return surf_descriptor_in_lanes<lanes>(integral, keypoint);                           \
        }                                                                                         \
    }

FILD_WIDE_SURF(Avx2Surf, 8, "avx2");
FILD_WIDE_SURF(Avx512Surf, 16, "avx512f,avx512vl,avx512bw,avx512dq");

template <class Wide>
SurfKernels kernels_of(const char* processor)
{
    return {processor, Wide::fill, Wide::append_peaks, Wide::orient, Wide::describe};
}

bool has_avx512()
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
}
}  // namespace
#endif

SurfKernels portable_surf_kernels()
{
    return {"portable", fill_determinants, append_row_peaks, dominant_orientation, surf_descriptor};
}

std::vector<SurfKernels> surf_kernels()
{
    std::vector<SurfKernels> kernels{portable_surf_kernels()};
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2")) kernels.push_back(kernels_of<Avx2Surf>("AVX2"));
    if (has_avx512()) kernels.push_back(kernels_of<Avx512Surf>("AVX-512"));
#endif
    return kernels;
}

}  // namespace fild
