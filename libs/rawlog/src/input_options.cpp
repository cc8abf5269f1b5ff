// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/input_options.h"

#include "fild/core/camera_model.h"

#include <regex>
#include <stdexcept>

namespace fild
{
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
