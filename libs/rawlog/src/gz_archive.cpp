// SPDX-License-Identifier: BSD-3-Clause
#include "gz_archive.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fild
{
namespace
{
constexpr std::uintmax_t kLeastBuffer = 1U << 11U;  // bytes
constexpr std::uintmax_t kLargestBuffer = 1U << 16U;
/** zlib counts in int. */
constexpr std::size_t kMaxBlockBytes = std::size_t{1} << 30U;

/** Progress shows in steps of one buffer: about two hundred of them, as far as that is sensible. */
unsigned buffer_for(const std::string& path)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) return kLargestBuffer;
    return static_cast<unsigned>(std::clamp(size / 200, kLeastBuffer, kLargestBuffer));
}

GzHandle open_gz(const std::string& path, const char* mode, unsigned buffer)
{
    GzHandle file(gzopen(path.c_str(), mode));
    if (file) gzbuffer(file.get(), buffer);
    return file;
}
}  // namespace

GzReader::GzReader(const std::string& path) : file_(open_gz(path, "rb", buffer_for(path)))
{
    if (!file_)
        throw std::runtime_error("cannot read " + path + ": " +
                                 std::generic_category().message(errno));
}

bool GzReader::at_end()
{
    const int byte = gzgetc(file_.get());
    if (byte >= 0)
    {
        gzungetc(byte, file_.get());
        return false;
    }
    if (!problem().empty()) fail();
    return true;
}

std::uint64_t GzReader::stored_bytes_read() const
{
    return static_cast<std::uint64_t>(std::max<z_off_t>(0, gzoffset(file_.get())));
}

std::size_t GzReader::read(void* target, std::size_t count)
{
    std::size_t done = 0;
    while (done < count)
    {
        const auto block = static_cast<unsigned>(std::min(count - done, kMaxBlockBytes));
        const int got = gzread(file_.get(), static_cast<char*>(target) + done, block);
        if (got <= 0) fail();
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::size_t GzReader::write(const void*, std::size_t)
{
    throw std::logic_error("GzReader does not write");
}

std::string GzReader::problem() const
{
    int code = Z_OK;
    const std::string text = gzerror(file_.get(), &code);
    if (code == Z_OK || code == Z_STREAM_END) return "";
    if (code == Z_BUF_ERROR) return "the compressed data is cut off";
    return "the compressed data is damaged (" + text + ")";
}

void GzReader::fail()
{
    failure_ = problem().empty() ? "the file ends inside an entry" : problem();
    throw std::runtime_error(failure_);
}

GzWriter::GzWriter(const std::string& temporary_path, std::string path)
    : path_(std::move(path)), file_(open_gz(temporary_path, "wb1", kLargestBuffer))
{
    if (!file_)
        throw std::runtime_error("cannot write " + path_ + ": " +
                                 std::generic_category().message(errno));
}

void GzWriter::close()
{
    if (gzclose(file_.release()) != Z_OK) fail();
}

std::size_t GzWriter::read(void*, std::size_t)
{
    throw std::logic_error("GzWriter does not read");
}

std::size_t GzWriter::write(const void* source, std::size_t count)
{
    for (std::size_t done = 0; done < count;)
    {
        const auto block = static_cast<unsigned>(std::min(count - done, kMaxBlockBytes));
        if (gzwrite(file_.get(), static_cast<const char*>(source) + done, block) <= 0) fail();
        done += block;
    }
    return count;
}

void GzWriter::fail() const
{
    throw std::runtime_error("cannot write " + path_ + " to its end: is the disk full?");
}

}  // namespace fild
