// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/input_options.h"

#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fild
{
/** Decides which camera is wanted by its label, and remembers all labels it was shown.
 *  Not thread-safe: one caller at a time. */
class CameraLabels
{
 public:
    /** By [input] sensor_label, a regular expression for the whole label; a label of more than 255
     *  characters never matches. When it is empty: the label of the left camera that stereo_labels
     *  names, else the first camera's label.
     *  \throw std::regex_error. */
    explicit CameraLabels(const TInputOptions& options);

    /** Notes the label of a camera observation; true when it is wanted. */
    bool accepts_camera(const std::string& label);
    /** True for a label that would be wanted if it came now. */
    bool could_want(const std::string& label) const
    {
        return (!pattern_ && !first_) || wants(label);
    }
    /** Notes the label of an observation that holds no image. */
    void note_other(const std::string& label) { others_.insert(label); }

    /** Camera labels seen and not wanted, sorted. */
    std::vector<std::string> ignored() const;
    /** "camera labels there: A, B; others: C", each sorted, "none" where there is none. */
    std::string describe() const;

 private:
    bool wants(const std::string& label) const;

    std::optional<std::regex> pattern_;
    std::optional<std::string> first_;
    std::set<std::string> cameras_;
    std::set<std::string> others_;
};

}  // namespace fild
