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
/** A rawlog that stops in the middle: it was cut off, is damaged, or holds a class of object that
 *  is not known here and so cannot be stepped over. All that next() gave before is good. */
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
 *  (whose observations come in their order), or one serialized mrpt::obs::CRawlog, which alone is
 *  loaded whole. Deterministic.
 *  Not thread-safe: one caller at a time. */
class RawlogReader
{
 public:
    /** \throw std::runtime_error naming the path when there is no such file, when it is empty, or
     *         when it does not begin like a rawlog (and then what it seems to be). */
    explicit RawlogReader(const std::string& path);
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
