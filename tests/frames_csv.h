// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "temporary_folder.h"

#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace fild::testing
{
inline std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/** The columns of frames.csv that tests look at. */
struct FrameRow
{
    std::size_t frame = 0;
    std::optional<std::size_t> candidate;
    std::size_t inliers = 0;
    bool accepted = false;
    std::string rejection;
};

/** All rows of a frames.csv whose labels hold no comma. */
inline std::vector<FrameRow> read_frames_csv(const std::string& path)
{
    std::vector<FrameRow> rows;
    const auto lines = lines_of(read_text(path));
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
        std::vector<std::string> fields;
        std::istringstream stream(lines[i]);
        for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
        fields.resize(10);  // getline drops a last empty field
        FrameRow row;
        row.frame = std::stoul(fields[0]);
        if (!fields[4].empty()) row.candidate = std::stoul(fields[4]);
        row.inliers = std::stoul(fields[7]);
        row.accepted = fields[8] == "1";
        row.rejection = fields[9];
        rows.push_back(row);
    }
    return rows;
}

}  // namespace fild::testing
