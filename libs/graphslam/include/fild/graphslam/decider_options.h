// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/stream/loop_closure_stream.h"

#include <mrpt/system/COutputLogger.h>

#include <string>

namespace fild
{
/** What a decider reads from its section of an engine's .ini file. Value type. */
struct DeciderOptions
{
    mrpt::system::VerbosityLevel verbosity = mrpt::system::LVL_INFO;  ///< `class_verbosity`, 0 to 3
    TLoopClosureStreamOptions stream;  ///< of the configuration that `fild_config` names
    TGraphOptions graph;  ///< likewise
};

/** Reads `class_verbosity` and `fild_config` of a section. The latter names a configuration of
 *  rawlog-loop-closure, such as those in config-ini; a relative path begins at the engine's .ini
 *  file. Other keys of the section are passed over, as MRPT's deciders do.
 *  \throw std::runtime_error naming file, section and key when `fild_config` is not there or
 *         `class_verbosity` is no level, or as load_ini_file() and load_sections(). */
DeciderOptions load_decider_options(const std::string& engine_ini, const std::string& section);

}  // namespace fild
