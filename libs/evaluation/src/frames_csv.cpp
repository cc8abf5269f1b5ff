// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/frames_csv.h"

#include "fild/core/parse_number.h"

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
constexpr const char* kHeader =
    "frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
    "rejection";
constexpr std::size_t kColumns = 10;

/** The fields of one CSV line (RFC 4180). */
std::vector<std::string> split_fields(const std::string& line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

/** One line of the file, which knows where it stands. */
class Row
{
 public:
    Row(const std::string& line, std::string origin)
        : fields_(split_fields(line)), origin_(std::move(origin))
    {
        if (fields_.size() != kColumns)
            fail(std::to_string(fields_.size()) + " columns instead of " +
                 std::to_string(kColumns));
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error(origin_ + ": " + what);
    }

    const std::string& text(std::size_t column) const { return fields_[column]; }

    template <class Number>
    Number number(std::size_t column) const
    {
        const auto value = parse_number<Number>(fields_[column]);
        if (!value)
            fail("'" + fields_[column] + "' is not a number as column " +
                 std::to_string(column + 1) + " holds");
        return *value;
    }

 private:
    std::vector<std::string> fields_;
    std::string origin_;
};

Rejection parse_rejection(const Row& row, const std::string& word)
{
    for (const auto rejection : all_rejections())
        if (to_word(rejection) == word) return rejection;
    row.fail("'" + word + "' is no reason to reject a frame");
}

FrameVerdict parse_verdict(const Row& row)
{
    FrameVerdict verdict;
    verdict.frame = FrameId{row.number<std::uint64_t>(0)};
    verdict.timestamp = row.number<double>(1);
    verdict.sensor_label = row.text(2);
    verdict.keypoints = row.number<std::size_t>(3);
    if (!row.text(4).empty())
        verdict.candidate = Candidate{FrameId{row.number<std::uint64_t>(4)}, row.number<double>(5)};
    verdict.matches = row.number<std::size_t>(6);
    verdict.inliers = row.number<std::size_t>(7);
    verdict.rejection = parse_rejection(row, row.text(9));
    if (row.text(8) != (verdict.accepted() ? "1" : "0"))
        row.fail("accepted is '" + row.text(8) + "', which the rejection contradicts");
    if (verdict.accepted() && !verdict.candidate) row.fail("accepted without a candidate");
    if (verdict.candidate && verdict.candidate->frame >= verdict.frame)
        row.fail("the candidate is not an earlier frame");
    return verdict;
}
}  // namespace

std::vector<FrameVerdict> read_frames_csv(const std::string& path)
{
    std::ifstream file(path);
    std::string line;
    if (!file || !std::getline(file, line))
        throw std::runtime_error("cannot read '" + path +
                                 "': " + std::generic_category().message(errno == 0 ? EIO : errno));
    if (line != kHeader)
        throw std::runtime_error(path + " does not begin with the header of frames.csv");
    std::vector<FrameVerdict> verdicts;
    while (std::getline(file, line))
    {
        const Row row(line, path + " line " + std::to_string(verdicts.size() + 2));
        verdicts.push_back(parse_verdict(row));
        if (to_index(verdicts.back().frame) != verdicts.size() - 1)
            row.fail("frame " + row.text(0) + " where frame " +
                     std::to_string(verdicts.size() - 1) + " is expected");
    }
    if (verdicts.empty()) throw std::runtime_error(path + " has no frame");
    return verdicts;
}

}  // namespace fild
