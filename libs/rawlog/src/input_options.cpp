// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/input_options.h"

#include "camera_labels.h"
#include "fild/core/camera_model.h"
#include "text_lines.h"

#include <regex>
#include <stdexcept>

namespace fild
{
namespace
{
/** \throw std::invalid_argument unless the text is empty, `none` or two labels. */
void check_stereo_labels(const TInputOptions& options)
{
    const auto& text = options.stereo_labels;
    const auto pair = options.named_pair();
    if (!pair && !options.finds_pairs() && text != "none")
        throw std::invalid_argument("stereo_labels='" + text +
                                    "' is neither LEFT,RIGHT, two labels of cameras, nor none");
    if (pair && !CameraLabels(options).could_want(pair->left))
        throw std::invalid_argument("sensor_label='" + options.sensor_label +
                                    "' does not take the left camera of stereo_labels='" + text +
                                    "'; leave sensor_label empty");
}
}  // namespace

std::optional<StereoLabels> TInputOptions::named_pair() const
{
    const auto comma = stereo_labels.find(',');
    if (comma == std::string::npos || stereo_labels.find(',', comma + 1) != std::string::npos)
        return std::nullopt;
    StereoLabels labels{trim(stereo_labels.substr(0, comma)),
                        trim(stereo_labels.substr(comma + 1))};
    if (labels.left.empty() || labels.right.empty() || labels.left == labels.right)
        return std::nullopt;
    return labels;
}

void TInputOptions::describe(OptionVisitor& visitor)
{
    visitor.text("sensor_label", sensor_label);
    visitor.text("images_dir", images_dir);
    visitor.choice<OnMissingImage>(
        "on_missing_image",
        on_missing_image,
        {{"skip", OnMissingImage::skip}, {"stop", OnMissingImage::stop}});
    visitor.flag("undistort", undistort);
    visitor.text("camera_parameters", camera_parameters);
    visitor.text("stereo_labels", stereo_labels);
    visitor.real("stereo_tolerance_seconds", stereo_tolerance_seconds, 0, 1);
    visitor.integer("max_entry_megabytes", max_entry_megabytes, 1, 65536);
}

void TInputOptions::check_between_fields() const
{
    constexpr std::size_t kLongestPattern = 1000;  // std::regex goes deeper with its length
    if (sensor_label.size() > kLongestPattern)
        throw std::invalid_argument("sensor_label has " + std::to_string(sensor_label.size()) +
                                    " characters, more than " + std::to_string(kLongestPattern));
    try
    {
        const std::regex tried(sensor_label);
    }
    catch (const std::regex_error& error)
    {
        throw std::invalid_argument("sensor_label='" + sensor_label +
                                    "' is not a regular expression: " + error.what());
    }
    check_stereo_labels(*this);
    if (camera_parameters.empty()) return;
    try
    {
        parse_camera_model(camera_parameters, "camera_parameters");
    }
    catch (const std::runtime_error& error)
    {
        throw std::invalid_argument(error.what());
    }
}

}  // namespace fild
