// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/whole_file.h"
#include "fild/graph/graph_files.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <stdexcept>

namespace fild
{
void write_simple_map(const std::string& path,
                      const PoseGraph& graph,
                      const KeyframeObservations& observations)
{
    mrpt::maps::CSimpleMap map;
    for (const auto& node : graph.nodes)
    {
        const auto found = observations.find(node.frame);
        if (found == observations.end()) continue;
        const auto frame = mrpt::obs::CSensoryFrame::Create();
        for (const auto& observation : found->second) frame->insert(observation);
        map.insert(mrpt::poses::CPose3DPDFGaussian::Create(node.map_from_robot), frame);
    }
    WholeFile file(path);
    if (!map.saveToFile(file.temporary_path()))
        throw std::runtime_error("cannot write " + path + "; is the disk full?");
    file.commit();
}

}  // namespace fild
