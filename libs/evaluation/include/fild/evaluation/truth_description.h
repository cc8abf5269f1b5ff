// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/protocol.h"

#include <string>
#include <vector>

namespace fild
{
/** The ground truth that scores were made with, as a report states it. */
struct TruthDescription
{
    std::string file;
    std::string content;  ///< GroundTruth::content
    std::vector<std::string> remarks;
    Protocol protocol;
};

}  // namespace fild
