// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app_main.h"
#include "fild/run/truth.h"

#include <optional>
#include <string>

namespace fild
{
/** The arguments with which an app is given ground truth. */
struct TruthArguments
{
    TruthArguments(TCLAP::CmdLine& command, bool required)
        : protocol("p",
                   "protocol",
                   "When a loop closure is right. Labels: exact (default) or window:FRAMES. Poses: "
                   "radius:METRES[,DOUBTFUL] (radius:5)",
                   false,
                   "",
                   "PROTOCOL",
                   command),
          trajectory("",
                     "true-trajectory",
                     "True poses for ATE and RPE, when the ground truth is labels",
                     false,
                     "",
                     "FILE",
                     command),
          sensor("",
                 "truth-sensor",
                 "Of a rawlog: label of the sensor whose poses are the truth",
                 false,
                 "",
                 "LABEL",
                 command),
          file("g",
               "ground-truth",
               "List of loops, MATLAB loop matrix, TUM or KITTI poses, rawlog with poses or GPS",
               required,
               "",
               "FILE",
               command)
    {
    }

    /** Nothing when no ground truth is given. Looks into the file, so that a wrong one is reported
     *  before the long work begins.
     *  \throw WrongUsage, std::invalid_argument, std::runtime_error as protocol_for(). */
    std::optional<TruthOptions> options()
    {
        if (protocol.isSet() && protocol.getValue().empty())
            throw WrongUsage("--protocol is empty");
        if (file.isSet())
            return TruthOptions{file.getValue(),
                                sensor.getValue(),
                                protocol_for(file.getValue(), protocol.getValue()),
                                trajectory.getValue()};
        if (protocol.isSet() || sensor.isSet() || trajectory.isSet())
            throw WrongUsage(
                "--protocol, --truth-sensor and --true-trajectory belong to --ground-truth");
        return std::nullopt;
    }

    using Text = TCLAP::ValueArg<std::string>;
    Text protocol;
    Text trajectory;
    Text sensor;
    Text file;
};

}  // namespace fild
