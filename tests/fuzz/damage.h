// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <string>

namespace fild::fuzz
{
/** What became of a file. Value type. */
struct Damaged
{
    std::string bytes;
    std::size_t first_change = 0;  ///< everything before this byte is as it was
};

/** Damages bytes in one to four places: flips a bit, sets a byte or a number of four bytes to an
 *  extreme, takes out, doubles or moves a stretch, cuts the end off. Deterministic. */
Damaged damage(std::string bytes, std::mt19937_64& random);

/** As damage(), for text: exchanges words and characters too. Deterministic. */
Damaged damage_text(std::string text, std::mt19937_64& random);

}  // namespace fild::fuzz
