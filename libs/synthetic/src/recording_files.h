// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/whole_file.h"
#include "fild/rawlog/rawlog_writer.h"
#include "fild/rawlog/whole_folder.h"

#include <mrpt/img/CImage.h>
#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** All files of a synthetic recording; they appear under their names together, by commit().
 *  Not thread-safe: one caller at a time. */
class RecordingFiles
{
 public:
    /** \throw std::invalid_argument when the path is not of the form NAME.rawlog.
     *  \throw std::runtime_error when one of the files exists already or cannot be created. */
    RecordingFiles(const std::string& rawlog_path, bool embed);
    RecordingFiles(const RecordingFiles&) = delete;
    RecordingFiles& operator=(const RecordingFiles&) = delete;
    ~RecordingFiles();

    RawlogWriter& rawlog() { return rawlog_; }
    std::ostream& poses() { return poses_.stream(); }
    std::ostream& loops() { return loops_.stream(); }

    /** Takes an image in. \param name  its file in the folder of images, ending in ".jpg". \return
     *  what is to stand in the rawlog: a reference to the file, or the pixels (shared).
     *  \throw std::runtime_error when the disk is full. */
    mrpt::img::CImage add_image(const std::string& name, const cv::Mat& image) const;

    /** Gives everything its name. \return the names, the rawlog's first.
     *  \throw std::runtime_error when the disk is full; then none of them is there. */
    std::vector<std::string> commit();

 private:
    struct Names;
    explicit RecordingFiles(const Names& names);

    std::vector<std::filesystem::path> to_remove_;  ///< has its name, but not yet all others
    std::vector<std::string> paths_;
    RawlogWriter rawlog_;
    WholeFile poses_;
    WholeFile loops_;
    std::optional<WholeFolder> images_;
};

}  // namespace fild
