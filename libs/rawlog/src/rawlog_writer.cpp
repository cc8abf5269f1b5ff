// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/rawlog_writer.h"

#include "fild/core/whole_file.h"
#include "gz_archive.h"
#include "mrpt_reason.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <exception>
#include <stdexcept>

namespace fild
{
struct RawlogWriter::State
{
    explicit State(const std::string& path) : file(path), archive(file.temporary_path(), path) {}

    void write(const mrpt::serialization::CSerializable& object);

    WholeFile file;
    GzWriter archive;
};

void RawlogWriter::State::write(const mrpt::serialization::CSerializable& object)
{
    try
    {
        archive << object;
    }
    catch (const std::exception& error)  // MRPT puts a call stack around the writer's
    {
        throw std::runtime_error(mrpt_reason(error));
    }
}

RawlogWriter::RawlogWriter(const std::string& path) : state_(std::make_unique<State>(path)) {}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::obs::CObservation& observation)
{
    state_->write(observation);
}

void RawlogWriter::write(const mrpt::obs::CActionCollection& actions,
                         const mrpt::obs::CSensoryFrame& observations)
{
    state_->write(actions);
    state_->write(observations);
}

void RawlogWriter::commit()
{
    state_->archive.close();
    state_->file.commit();
}

}  // namespace fild
