// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/pose_csv.h"

#include <charconv>

namespace fild
{
namespace
{
/** The shortest text that reads back as the number. */
std::string text_of(double number)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
    return {text.data(), end.ptr};
}
}  // namespace

PoseCsv::PoseCsv(const std::string& path) : file_(path)
{
    auto& out = file_.stream();
    out << "frame";
    for (const auto* trajectory : {"input", "optimized"})
        for (const auto* number : {"x", "y", "z", "qx", "qy", "qz", "qw"})
            out << ',' << trajectory << '_' << number;
    out << '\n';
}

void PoseCsv::add(FrameId frame, const PoseNumbers& input, const PoseNumbers& optimized)
{
    auto& out = file_.stream();
    out << to_index(frame);
    for (const auto* pose : {&input, &optimized})
        for (const double number : *pose) out << ',' << text_of(number);
    out << '\n';
}

}  // namespace fild
