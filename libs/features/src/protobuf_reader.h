// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace fild
{
/** Reads a message of Protocol Buffers field by field, in the order of the file, and believes
 *  nothing: https://protobuf.dev/programming-guides/encoding. Refers to the bytes that it was
 *  given.
 *
 *  All members throw std::runtime_error when the bytes are damaged, or the field has another type
 *  than is asked for. Not thread-safe: one caller at a time. */
class ProtobufReader
{
 public:
    explicit ProtobufReader(std::string_view bytes) : rest_(bytes) {}

    /** Goes to the next field. \return false when there is none. */
    bool next();

    /** Number of the field in the message's description. */
    std::uint64_t field() const { return field_; }

    std::int64_t integer() const;
    float real() const;
    /** A string, or a message of its own. */
    std::string_view bytes() const;

    /** Of a repeated field, whose values come one by one or many together. */
    void append_to(std::vector<std::int64_t>& integers) const;
    void append_to(std::vector<float>& reals) const;

 private:
    enum class WireType
    {
        varint = 0,
        eight_bytes = 1,
        length_and_bytes = 2,
        four_bytes = 5
    };

    std::string_view rest_;
    std::uint64_t field_ = 0;
    WireType type_ = WireType::varint;
    std::uint64_t number_ = 0;
    std::string_view bytes_;
};

/** Numbers of four or eight bytes each, as a little-endian machine keeps them.
 *  \throw std::runtime_error when the bytes end within one. */
template <class Number>
std::vector<Number> to_numbers(std::string_view bytes);

}  // namespace fild
