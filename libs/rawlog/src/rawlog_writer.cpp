// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/rawlog_writer.h"

#include "fild/core/whole_file.h"
#include "gz_archive.h"
#include "mrpt_reason.h"

#include <mrpt/obs/CObservation.h>

#include <exception>
#include <stdexcept>

namespace fild
{
struct RawlogWriter::State
{
    explicit State(const std::string& path) : file(path), archive(file.temporary_path(), path) {}

    WholeFile file;
    GzWriter archive;
};

RawlogWriter::RawlogWriter(const std::string& path) : state_(std::make_unique<State>(path)) {}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::obs::CObservation& observation)
{
    try
    {
        state_->archive << observation;
    }
    catch (const std::exception& error)  // MRPT puts a call stack around the writer's
    {
        throw std::runtime_error(mrpt_reason(error));
    }
}

void RawlogWriter::commit()
{
    state_->archive.close();
    state_->file.commit();
}

}  // namespace fild
