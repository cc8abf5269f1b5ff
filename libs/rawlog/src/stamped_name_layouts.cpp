// SPDX-License-Identifier: BSD-3-Clause
// Layouts whose file names carry the time: Blanco, Moreno and Gonzalez, "A collection of outdoor
// robotic datasets with centimeter-accuracy ground truth" (Autonomous Robots 2009), and Smith et
// al., "The New College vision and laser data set" (IJRR 2009).
#include "fild/core/parse_number.h"
#include "fild/rawlog/image_layouts.h"
#include "folder_entries.h"
#include "image_pairs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** What stands around the time in a file's name, its extension not counted. */
struct NameForm
{
    std::string prefix;
    std::string suffix;
};

/** The names of a stereo camera's images. */
struct NameForms
{
    NameForm left;
    NameForm right;
    std::string example;  ///< of a left one
};

/** The text of the time in a name of that form; nothing for another name. */
std::optional<std::string> time_in(const std::string& path, const NameForm& form)
{
    const auto stem = fs::path(path).stem().string();
    const auto around = form.prefix.size() + form.suffix.size();
    if (stem.size() < around || stem.compare(0, form.prefix.size(), form.prefix) != 0 ||
        stem.compare(stem.size() - form.suffix.size(), form.suffix.size(), form.suffix) != 0)
        return std::nullopt;
    return stem.substr(form.prefix.size(), stem.size() - around);
}

/** Images of one form, by the text of their time. */
using ImagesByTime = std::map<std::string, ListedImage>;

ImagesByTime images_of_form(const std::vector<std::string>& paths, const NameForm& form)
{
    ImagesByTime images;
    for (const auto& path : paths)
    {
        const auto text = time_in(path, form);
        if (!text) continue;
        const auto seconds = parse_number<double>(*text);
        if (!seconds)
            throw std::runtime_error(path + ": '" + *text +
                                     "' is no time in seconds; rename the image or take it away");
        const auto [other, is_new] = images.emplace(*text, ListedImage{{path, path}, seconds});
        if (!is_new)
            throw std::runtime_error(path + " and " + other->second.path +
                                     " are of the same time; take one away");
    }
    return images;
}

/** Takes the images away that have no partner of the same time. \return how many. */
std::size_t drop_without(const ImagesByTime& partners, ImagesByTime& images)
{
    const auto before = images.size();
    for (auto image = images.begin(); image != images.end();)
        image = partners.count(image->first) != 0 ? std::next(image) : images.erase(image);
    return before - images.size();
}

std::vector<ListedImage> in_order_of_time(const ImagesByTime& images)
{
    std::vector<ListedImage> ordered;
    for (const auto& [time, image] : images) ordered.push_back(image);
    std::stable_sort(ordered.begin(),
                     ordered.end(),
                     [](const ListedImage& a, const ListedImage& b)
                     { return *a.seconds < *b.seconds; });
    return ordered;
}

Recording paired_by_time(ImagesByTime left, ImagesByTime right)
{
    const auto lonely_left = drop_without(right, left);
    const auto lonely_right = drop_without(left, right);
    if (left.empty()) return {};
    auto recording = mono_recording(stamp_images(in_order_of_time(left), {}));
    const auto right_in_order = in_order_of_time(right);
    for (std::size_t i = 0; i < right_in_order.size(); ++i)
        recording.frames[i].right = right_in_order[i];
    if (lonely_left != 0)
        recording.left_out.push_back(count_without(lonely_left, "left image", "right one"));
    if (lonely_right != 0)
        recording.left_out.push_back(count_without(lonely_right, "right image", "left one"));
    return recording;
}

/** Two cameras that recorded by themselves. */
Recording two_cameras(const ImagesByTime& left, const ImagesByTime& right)
{
    auto recording = mono_recording(stamp_images(in_order_of_time(left), {}));
    if (!right.empty()) recording.right_camera = stamp_images(in_order_of_time(right), {});
    return recording;
}

/** The images of a folder, by the text of their time. */
struct BothImages
{
    ImagesByTime left;
    ImagesByTime right;
};

/** \throw std::runtime_error when there is no left image, or right ones and no calibration. */
BothImages read_named(const std::string& folder,
                      const NameForms& forms,
                      const std::optional<Calibration>& calibration)
{
    const auto paths = image_paths_in(folder);
    BothImages images{images_of_form(paths, forms.left), images_of_form(paths, forms.right)};
    if (images.left.empty())
        throw std::runtime_error("no image in " + folder + " has a name like " + forms.example +
                                 example_in(folder) + "; name the folder that holds such images");
    if (!images.right.empty())
        check_stereo_calibration(calibration, "take the right images out of " + folder);
    return images;
}
}  // namespace

Recording read_malaga_layout(const std::string& folder,
                             const std::optional<Calibration>& calibration)
{
    const auto images = read_named(
        folder,
        {{"CAMERA_LEFT_", ""}, {"CAMERA_RIGHT_", ""}, "CAMERA_LEFT_1226322035.529528.jpg"},
        calibration);
    auto recording = two_cameras(images.left, images.right);
    recording.calibration = calibration;
    return recording;
}

Recording read_newcollege_layout(const std::string& folder,
                                 const std::optional<Calibration>& calibration)
{
    const auto images = read_named(folder,
                                   {{"StereoImage__", "-left"},
                                    {"StereoImage__", "-right"},
                                    "StereoImage__1225719815.864878-left.pnm"},
                                   calibration);
    auto recording = images.right.empty() ? two_cameras(images.left, {})
                                          : paired_by_time(images.left, images.right);
    recording.calibration = calibration;
    if (recording.frames.empty())
        throw std::runtime_error("none of the left images in " + folder + " has a right one of " +
                                 "the same time, such as " + images.left.begin()->second.path +
                                 " and " + images.right.begin()->second.path +
                                 "; take the right images away, or rename them");
    return recording;
}

}  // namespace fild
