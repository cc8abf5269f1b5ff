// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <memory>
#include <string>
#include <zlib.h>

namespace fild
{
/** Closes a gzip file that nobody asked to close with a check. */
struct GzCloser
{
    void operator()(gzFile file) const { gzclose(file); }
};
using GzHandle = std::unique_ptr<gzFile_s, GzCloser>;

/** Reads MRPT objects from a plain or gzipped file.
 *
 *  MRPT's own CFileGZInputStream is not used: it cannot tell a gzip stream that was cut off from
 *  one that ended, nor look ahead for the end of the file before an object begins.
 *  Not thread-safe: one caller at a time. */
class GzReader : public mrpt::serialization::CArchive
{
 public:
    /** \throw std::runtime_error with path and reason when the file cannot be opened. */
    explicit GzReader(const std::string& path);

    /** True when not one more byte follows. \throw std::runtime_error when that cannot be told:
     *  the compressed data is damaged or cut off. */
    bool at_end();

    /** Bytes of the file, as stored, consumed up to now; a gzip file is read in blocks. */
    std::uint64_t stored_bytes_read() const;

    /** Why a read failed; empty while none has. MRPT swallows the message of what read() throws. */
    const std::string& failure() const { return failure_; }

 private:
    std::size_t read(void* target, std::size_t count) override;
    std::size_t write(const void* source, std::size_t count) override;
    std::string problem() const;
    [[noreturn]] void fail();

    GzHandle file_;
    std::string failure_;
};

/** Writes MRPT objects to a gzipped file, noticing each failed write, which MRPT's
 *  CFileGZOutputStream does not. Not thread-safe: one caller at a time. */
class GzWriter : public mrpt::serialization::CArchive
{
 public:
    /** \param temporary_path  where to write. \param path  the file to name in errors.
     *  \throw std::runtime_error with path and reason. */
    GzWriter(const std::string& temporary_path, std::string path);

    /** Writes what is still buffered. \throw std::runtime_error when that fails (disk full). */
    void close();

 private:
    std::size_t read(void* target, std::size_t count) override;
    std::size_t write(const void* source, std::size_t count) override;
    [[noreturn]] void fail() const;

    std::string path_;
    GzHandle file_;
};

}  // namespace fild
