// SPDX-License-Identifier: BSD-3-Clause
#include "camera_labels.h"

#include <algorithm>
#include <iterator>

namespace fild
{
namespace
{
constexpr std::size_t kLongestMatched = 255;

std::string join(const std::set<std::string>& labels)
{
    std::string joined;
    for (const auto& label : labels)
        joined += (joined.empty() ? "" : ", ") + (label.empty() ? "'' (no label)" : label);
    return joined.empty() ? "none" : joined;
}
}  // namespace

CameraLabels::CameraLabels(const TInputOptions& options)
{
    if (!options.sensor_label.empty()) pattern_.emplace(options.sensor_label);
    if (const auto pair = options.named_pair()) first_ = pair->left;
}

bool CameraLabels::accepts_camera(const std::string& label)
{
    if (!first_) first_ = label;
    cameras_.insert(label);
    return wants(label);
}

std::vector<std::string> CameraLabels::ignored() const
{
    std::vector<std::string> labels;
    std::copy_if(cameras_.begin(),
                 cameras_.end(),
                 std::back_inserter(labels),
                 [this](const std::string& label) { return !wants(label); });
    return labels;
}

std::string CameraLabels::describe() const
{
    return "camera labels there: " + join(cameras_) + "; others: " + join(others_);
}

bool CameraLabels::wants(const std::string& label) const
{
    if (!pattern_) return label == first_;
    // std::regex_match() goes one call deeper for each character: a long label, which only a
    // damaged rawlog has, overflows the stack.
    return label.size() <= kLongestMatched && std::regex_match(label, *pattern_);
}

}  // namespace fild
