// SPDX-License-Identifier: BSD-3-Clause
#include "protobuf_reader.h"

#include <cstring>
#include <stdexcept>

namespace fild
{
namespace
{
[[noreturn]] void refuse(const char* reason)
{
    throw std::runtime_error(std::string("it is damaged, or not an ONNX file: ") + reason);
}

/** Takes bytes from the front. */
std::string_view take(std::string_view& rest, std::uint64_t count)
{
    if (count > rest.size()) refuse("it ends too early");
    const auto taken = rest.substr(0, count);
    rest.remove_prefix(count);
    return taken;
}

std::uint64_t take_varint(std::string_view& rest)
{
    constexpr unsigned kBitsOfAByte = 7;
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += kBitsOfAByte)
    {
        const auto byte = static_cast<unsigned char>(take(rest, 1).front());
        value |= std::uint64_t{byte & 0x7FU} << shift;
        if ((byte & 0x80U) == 0) return value;
    }
    refuse("a number has too many bytes");
}

std::uint64_t little_endian(std::string_view bytes)
{
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}
}  // namespace

template <class Number>
std::vector<Number> to_numbers(std::string_view bytes)
{
    if (bytes.size() % sizeof(Number) != 0) refuse("it ends within a number");
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

template std::vector<float> to_numbers(std::string_view bytes);
template std::vector<std::int64_t> to_numbers(std::string_view bytes);

bool ProtobufReader::next()
{
    if (rest_.empty()) return false;
    const auto key = take_varint(rest_);
    field_ = key >> 3U;
    type_ = static_cast<WireType>(key & 7U);
    switch (type_)
    {
        case WireType::varint:
            number_ = take_varint(rest_);
            return true;
        case WireType::eight_bytes:
            number_ = little_endian(take(rest_, 8));
            return true;
        case WireType::length_and_bytes:
            bytes_ = take(rest_, take_varint(rest_));
            return true;
        case WireType::four_bytes:
            number_ = little_endian(take(rest_, 4));
            return true;
    }
    refuse("a field is of no type");
}

std::int64_t ProtobufReader::integer() const
{
    if (type_ != WireType::varint) refuse("a field is not a whole number");
    return static_cast<std::int64_t>(number_);
}

float ProtobufReader::real() const
{
    if (type_ != WireType::four_bytes) refuse("a field is not a real number");
    const auto bits = static_cast<std::uint32_t>(number_);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

std::string_view ProtobufReader::bytes() const
{
    if (type_ != WireType::length_and_bytes) refuse("a field is neither a text nor a message");
    return bytes_;
}

void ProtobufReader::append_to(std::vector<std::int64_t>& integers) const
{
    if (type_ != WireType::length_and_bytes)
    {
        integers.push_back(integer());
        return;
    }
    for (auto rest = bytes_; !rest.empty();)
        integers.push_back(static_cast<std::int64_t>(take_varint(rest)));
}

void ProtobufReader::append_to(std::vector<float>& reals) const
{
    if (type_ != WireType::length_and_bytes)
    {
        reals.push_back(real());
        return;
    }
    const auto packed = to_numbers<float>(bytes_);
    reals.insert(reals.end(), packed.begin(), packed.end());
}

}  // namespace fild
