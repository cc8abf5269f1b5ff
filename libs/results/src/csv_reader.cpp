// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/csv_reader.h"

#include "fild/core/words.h"
#include "fild/results/csv_fields.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fild
{
const std::string& CsvField::text() const
{
    return reader_.fields_.at(position_);
}

void CsvField::fail(const std::string& what) const
{
    throw std::runtime_error(reader_.origin() + ", " + reader_.columns_.at(position_) + ": " +
                             what);
}

CsvReader::CsvReader(std::string path) : path_(std::move(path)), file_(path_)
{
    std::string header;
    if (!file_ || !std::getline(file_, header))
        throw std::runtime_error("cannot read '" + path_ +
                                 "': " + std::generic_category().message(errno == 0 ? EIO : errno));
    columns_ = split_csv_fields(header);
}

std::optional<std::size_t> CsvReader::position_of(const std::string& column) const
{
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns_.begin());
}

bool CsvReader::next()
{
    std::string record;
    const auto lines = read_csv_record(file_, record);
    if (lines == 0) return false;
    line_ = next_line_;
    next_line_ += lines;
    fields_ = split_csv_fields(record);
    if (fields_.size() != columns_.size())
        fail(count_of(fields_.size(), "column") + " instead of " + std::to_string(columns_.size()));
    return true;
}

void CsvReader::fail(const std::string& what) const
{
    throw std::runtime_error(origin() + ": " + what);
}

std::string CsvReader::origin() const
{
    return path_ + " line " + std::to_string(line_);
}

}  // namespace fild
