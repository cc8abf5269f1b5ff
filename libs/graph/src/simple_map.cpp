// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/whole_file.h"
#include "fild/graph/graph_files.h"

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

namespace fild
{
namespace
{
/** Is written as a CSimpleMap is, version 1, which every MRPT reads, with one keyframe at a time in
 *  memory. */
class StreamedSimpleMap : public mrpt::serialization::CSerializable
{
 public:
    StreamedSimpleMap(const PoseGraph& graph, const ObservationsAt& observations_at)
        : graph_(graph), observations_at_(observations_at)
    {
    }

    const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override
    {
        return CLASS_ID(mrpt::maps::CSimpleMap);
    }
    mrpt::rtti::CObject* clone() const override { return nullptr; }

 private:
    std::uint8_t serializeGetVersion() const override { return 1; }

    void serializeTo(mrpt::serialization::CArchive& out) const override
    {
        out.WriteAs<std::uint32_t>(graph_.nodes.size());
        for (const auto& node : graph_.nodes)
        {
            mrpt::obs::CSensoryFrame frame;
            for (const auto& observation : observations_at_(node.frame)) frame.insert(observation);
            out << mrpt::poses::CPose3DPDFGaussian(node.map_from_robot) << frame;
        }
    }

    void serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) override
    {
        throw std::logic_error("StreamedSimpleMap is only written");
    }

    const PoseGraph& graph_;
    const ObservationsAt& observations_at_;
};
}  // namespace

void write_simple_map(const std::string& path,
                      const PoseGraph& graph,
                      const ObservationsAt& observations_at)
{
    WholeFile file(path);
    mrpt::io::CFileGZOutputStream stream;
    if (!stream.open(file.temporary_path()))
        throw std::runtime_error("cannot write " + path + "; is the disk full?");
    const StreamedSimpleMap map(graph, observations_at);
    mrpt::serialization::archiveFrom(stream) << map;
    stream.close();
    file.commit();
}

}  // namespace fild
