// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kinds.h"

namespace fild::fuzz
{
/** Good files of a kind, made by our own tools and MRPT's. \param folder  for files in between. */
std::vector<Sample> make_corpus(Kind kind, const std::string& folder);

/** Packs bytes as gzip does. */
std::string packed(const std::string& bytes, const std::string& folder);

}  // namespace fild::fuzz
