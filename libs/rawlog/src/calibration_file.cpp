// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/calibration_file.h"

#include "fild/core/parse_number.h"
#include "text_lines.h"

#include <stdexcept>

namespace fild
{
namespace
{
double parse_baseline(const TextLine& line)
{
    const std::string word = "baseline";
    if (line.text.compare(0, word.size(), word) != 0)
        throw std::runtime_error(line.origin + ": '" + line.text +
                                 "' follows the camera's line; only 'baseline METRES' may");
    const auto metres = parse_number<double>(trim(line.text.substr(word.size())));
    if (!metres || *metres <= 0)
        throw std::runtime_error(line.origin + ": '" + line.text +
                                 "' is not of the form 'baseline METRES', METRES above 0");
    return *metres;
}
}  // namespace

Calibration read_calibration_file(const std::string& path)
{
    const auto lines = read_text_lines(path);
    if (lines.empty())
        throw std::runtime_error("no calibration in " + path +
                                 "; write 'fx fy cx cy width height [k1 k2 p1 p2 [k3]]'");
    Calibration calibration;
    calibration.camera = parse_camera_model(lines[0].text, lines[0].origin);
    if (lines.size() > 1) calibration.baseline_m = parse_baseline(lines[1]);
    if (lines.size() > 2)
        throw std::runtime_error(lines[2].origin + ": '" + lines[2].text +
                                 "' follows the baseline; remove it");
    return calibration;
}

}  // namespace fild
