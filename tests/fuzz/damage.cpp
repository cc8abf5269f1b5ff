// SPDX-License-Identifier: BSD-3-Clause
#include "damage.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace fild::fuzz
{
namespace
{
/** 0 to count - 1; not std::uniform_int_distribution, which differs between libraries. */
std::size_t below(std::size_t count, std::mt19937_64& random)
{
    return count == 0 ? 0 : static_cast<std::size_t>(random() % count);
}

/** Where sizes and flags stand is more often tried than where pixels do. */
std::size_t place_in(const std::string& bytes, std::mt19937_64& random)
{
    constexpr std::size_t kHeader = 400;
    const bool near_start = below(4, random) == 0;
    return below(near_start ? std::min(bytes.size(), kHeader) : bytes.size(), random);
}

std::size_t length_of_stretch(std::mt19937_64& random)
{
    return std::size_t{1} << below(10, random);
}

void set_number(std::string& bytes, std::size_t at, std::mt19937_64& random)
{
    constexpr std::array<std::uint32_t, 10> kExtremes{
        0, 1, 0x7F, 0xFF, 0xFFFF, 0x10000, 0x100000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
    const auto number = kExtremes[below(kExtremes.size(), random)];
    const auto count = std::min(sizeof(number), bytes.size() - at);
    std::memcpy(bytes.data() + at, &number, count);
}

/** \return where the change begins. */
std::size_t damage_once(std::string& bytes, std::mt19937_64& random)
{
    auto at = place_in(bytes, random);
    const auto stretch = bytes.substr(at, length_of_stretch(random));
    switch (below(8, random))
    {
        case 0:
        case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8, random)));
            break;
        case 2:
            bytes[at] = static_cast<char>(below(256, random));
            break;
        case 3:
        case 4:
            set_number(bytes, at, random);
            break;
        case 5:
            bytes.erase(at, stretch.size());
            break;
        case 6:
        {
            const auto target = place_in(bytes, random);
            bytes.insert(target, stretch);
            at = target;
            break;
        }
        default:
            bytes.resize(at);
            break;
    }
    return at;
}

void exchange_word(std::string& text, std::size_t at, std::mt19937_64& random)
{
    const std::array<std::string, 14> words{"nan",
                                            "-1",
                                            "1e400",
                                            "-0",
                                            "99999999999999999999",
                                            "0x7",
                                            "",
                                            "\n",
                                            ",",
                                            "\"",
                                            "=",
                                            "[input]",
                                            "\xC3\x28",
                                            std::string(70000, '7')};
    const auto begin = text.find_last_of(" ,=\n", at);
    const auto start = begin == std::string::npos ? 0 : begin + 1;
    const auto end = text.find_first_of(" ,=\n", start);
    text.replace(
        start, end == std::string::npos ? end : end - start, words[below(words.size(), random)]);
}

template <class Once>
Damaged damage_several(std::string bytes, std::mt19937_64& random, Once&& once)
{
    Damaged damaged{std::move(bytes), 0};
    damaged.first_change = damaged.bytes.size();
    for (auto count = 1 + below(4, random); count > 0 && !damaged.bytes.empty(); --count)
        damaged.first_change = std::min(damaged.first_change, once(damaged.bytes));
    return damaged;
}
}  // namespace

Damaged damage(std::string bytes, std::mt19937_64& random)
{
    return damage_several(
        std::move(bytes), random, [&](std::string& all) { return damage_once(all, random); });
}

Damaged damage_text(std::string text, std::mt19937_64& random)
{
    return damage_several(std::move(text),
                          random,
                          [&](std::string& all) -> std::size_t
                          {
                              if (below(2, random) == 0) return damage_once(all, random);
                              exchange_word(all, below(all.size(), random), random);
                              return 0;
                          });
}

}  // namespace fild::fuzz
