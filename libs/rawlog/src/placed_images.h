// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/image_list.h"
#include "fild/rawlog/whole_folder.h"

#include <mrpt/img/CImage.h>
#include <opencv2/core/types.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace fild
{
/** An image as an observation holds it. */
struct PlacedImage
{
    mrpt::img::CImage image;  ///< pixels, or a file name in the folder of images
    cv::Size size;
};

/** Puts the images of a rawlog where they belong: into the observations, or into a folder beside
 *  the rawlog, each distinct file once. The folder appears as WholeFolder does.
 *  Not thread-safe: one caller at a time. */
class PlacedImages
{
 public:
    /** \param folder  nothing: the pixels are embedded. */
    explicit PlacedImages(const std::optional<std::filesystem::path>& folder);

    /** \param name  wanted in the folder; a number is added when it is taken.
     *  \throw std::runtime_error as load_checked, or when the disk is full. */
    PlacedImage place(const ImageFile& file, const std::filesystem::path& name);

    /** How many distinct files were placed. */
    std::size_t count() const { return known_.size(); }

    void commit();  ///< as WholeFolder::commit
    void keep();  ///< as WholeFolder::keep

 private:
    /** A file that was placed before. */
    struct Known
    {
        std::string name;  ///< in the folder
        cv::Size size;
    };

    std::string unused_name(const std::filesystem::path& wanted) const;

    std::optional<WholeFolder> folder_;
    std::map<std::string, Known> known_;  ///< by canonical path
    std::set<std::string> used_names_;
};

}  // namespace fild
