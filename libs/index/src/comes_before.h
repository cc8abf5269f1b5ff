// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

namespace fild
{
/** Most similar first, equals by frame: the order every index answers in. */
inline bool comes_before(const Candidate& a, const Candidate& b)
{
    if (a.similarity != b.similarity) return a.similarity > b.similarity;
    return a.frame < b.frame;
}

}  // namespace fild
