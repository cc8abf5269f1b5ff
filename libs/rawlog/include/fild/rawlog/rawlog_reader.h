// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
constexpr int kDefaultMaxEntryMegabytes = 256;

/** A rawlog that stops in the middle: it was cut off, is damaged, has an entry larger than allowed,
 *  or holds an object of a class, or of a version, that this MRPT does not know and so cannot step
 *  over. All that next() gave before is good. */
class TruncatedRawlog : public std::runtime_error
{
 public:
    TruncatedRawlog(const std::string& message, std::size_t entries_before, std::uint64_t byte_near)
        : std::runtime_error(message), entries_read(entries_before), byte_position(byte_near)
    {
    }

    std::size_t entries_read;  ///< whole entries of the rawlog before the bad one
    /** Bytes of the file consumed; a few thousand too many at most, as blocks are read. */
    std::uint64_t byte_position;
};

/** One thing that a rawlog tells: an observation, or the actions that led to the observations after
 *  them. Both null: the rawlog has ended. Value type. */
struct RawlogEntry
{
    std::shared_ptr<mrpt::obs::CObservation> observation;
    std::shared_ptr<mrpt::obs::CActionCollection> actions;
};

/** Reads the observations of a rawlog one after the other, in the order of the file, holding only
 *  one entry in memory. Plain or gzipped; made of observations, or of actions and sensory frames
 *  (whose observations come in their order), or serialized mrpt::obs::CRawlog. Deterministic.
 *
 *  MRPT trusts the sizes in a file: one flipped bit can end the process, or take all its memory. So
 *  a process of its own, a fork of this one, makes objects of each entry first, with little memory
 *  and 10 s of computing time; only the bytes of an entry that passes come here. As after any fork,
 *  locks that other threads hold at that moment stay locked in it: one that waits for such a lock
 *  is replaced after some seconds, twice at most; a program with threads should make its readers
 *  before them. The process ends with the reader, which sends the program a SIGCHLD. Not
 *  thread-safe: one caller at a time. */
class RawlogReader
{
 public:
    /** \param max_entry_megabytes  memory that one entry may take, unpacked (2^20 bytes, > 0): one
     *  that takes more is bad. Reading takes up to three times that for a moment.
     *  \throw std::runtime_error naming the path when there is no such file, when it is empty, or
     *         when it does not begin like a rawlog (and then what it seems to be). */
    explicit RawlogReader(const std::string& path,
                          int max_entry_megabytes = kDefaultMaxEntryMegabytes);
    RawlogReader(const RawlogReader&) = delete;
    RawlogReader& operator=(const RawlogReader&) = delete;
    ~RawlogReader();

    /** The next observation, or null at the clean end of the file and ever after; actions are
     * passed over. \throw TruncatedRawlog naming path, entries read and position; each later call
     * throws it again. */
    std::shared_ptr<mrpt::obs::CObservation> next();

    /** The next observation or actions; as next(), which may be called in turn. */
    RawlogEntry next_entry();

    /** Share of the stored (compressed) bytes consumed, in [0, 1]: for a progress line. */
    double fraction_read() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
