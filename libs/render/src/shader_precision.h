// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** Sees to it that MRPT's shaders compute in 32 bits.
 *
 *  MRPT 2.5 declares its matrices `mediump`. On processors that have 16-bit floats Mesa's llvmpipe
 *  takes it at its word: a camera 170 m from the origin is then drawn up to 8 cm away from where it
 *  stands, and turned by up to 0.03 degrees. This library therefore has a glShaderSource() of its
 *  own, which says `highp` instead and hands the source on to OSMesa's.
 *  \throw std::runtime_error when OSMesa has none. */
void require_precise_shaders();

}  // namespace fild
