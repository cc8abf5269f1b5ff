// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace fild::fuzz
{
/** The files that users hand to the apps. */
enum class Kind
{
    rawlog,
    rawlog_gz,
    ini,
    mat,
    csv,
    list,
    onnx,
    jpg,
    png
};

constexpr std::array<std::pair<Kind, const char*>, 9> kKinds{{{Kind::rawlog, "rawlog"},
                                                              {Kind::rawlog_gz, "rawlog_gz"},
                                                              {Kind::ini, "ini"},
                                                              {Kind::mat, "mat"},
                                                              {Kind::csv, "csv"},
                                                              {Kind::list, "list"},
                                                              {Kind::onnx, "onnx"},
                                                              {Kind::jpg, "jpg"},
                                                              {Kind::png, "png"}}};

/** A good file. Value type. */
struct Sample
{
    std::string name;  ///< of the reader, where a kind has several
    std::string bytes;
    std::vector<std::size_t> entry_ends;  ///< of a rawlog, in unpacked bytes
};

}  // namespace fild::fuzz
