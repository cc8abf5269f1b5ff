// SPDX-License-Identifier: BSD-3-Clause
// The odometry benchmark of Geiger, Lenz and Urtasun, "Are we ready for autonomous driving? The
// KITTI vision benchmark suite" (CVPR 2012).
#include "checked_image.h"
#include "fild/core/parse_number.h"
#include "fild/rawlog/image_layouts.h"
#include "folder_entries.h"
#include "image_pairs.h"
#include "text_lines.h"

#include <filesystem>
#include <stdexcept>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** Two cameras of the car, by their numbers in names of folders and rows. */
struct CameraPair
{
    char left;
    char right;
};

std::string image_dir(const std::string& folder, char camera)
{
    return (fs::path(folder) / (std::string("image_") + camera)).string();
}

CameraPair cameras_in(const std::string& folder)
{
    if (!fs::is_directory(folder))
        throw std::runtime_error("no such folder: '" + folder + "'; check the path");
    if (fs::is_directory(image_dir(folder, '0'))) return {'0', '1'};
    if (fs::is_directory(image_dir(folder, '2'))) return {'2', '3'};
    throw std::runtime_error("neither image_0 nor image_2 in " + folder + example_in(folder) +
                             "; name the folder of a KITTI sequence, with image_0/000000.png, "
                             "times.txt and calib.txt");
}

std::vector<StampedImage> stamped(const std::vector<ListedImage>& images,
                                  const std::string& folder,
                                  const TimestampSource& timestamps)
{
    if (!timestamps.file.empty() || timestamps.rate_hz) return stamp_images(images, timestamps);
    const auto times = (fs::path(folder) / "times.txt").string();
    if (!fs::exists(times))
        throw std::runtime_error("no time stamps: " + times +
                                 " does not exist; put it there, or give --timestamps FILE or "
                                 "--rate 10");
    return stamp_images(images, {times, std::nullopt});
}

/** Row `P0:` to `P3:` of calib.txt, a 3x4 matrix row by row. */
std::vector<double> projection_row(const std::string& calib_path, char camera)
{
    const auto name = std::string("P") + camera + ":";
    for (const auto& line : read_text_lines(calib_path))
    {
        if (line.text.compare(0, name.size(), name) != 0) continue;
        auto numbers = parse_numbers(line.text.substr(name.size()), line.origin);
        if (numbers.size() != 12)
            throw std::runtime_error(line.origin + ": expected 12 numbers behind " + name +
                                     ", got " + std::to_string(numbers.size()));
        if (!(numbers[0] > 0 && numbers[5] > 0))
            throw std::runtime_error(line.origin + ": the focal lengths must be positive");
        return numbers;
    }
    throw std::runtime_error("no line '" + name + " ...' in " + calib_path +
                             "; correct it, or give --calib FILE");
}

/** How far a camera's centre lies to the right of camera 0's, metres. */
double offset_to_the_right(const std::vector<double>& p)
{
    const double depth_offset = p[11];  // a few millimetres; 0 for the grey cameras
    return -(p[3] - p[2] * depth_offset) / p[0];
}

Calibration calibration_from(const std::string& calib_path,
                             CameraPair cameras,
                             bool stereo,
                             const ImageFile& first_image)
{
    const auto left = projection_row(calib_path, cameras.left);
    const auto size = load_checked(first_image).size();
    Calibration calibration;
    calibration.camera = {
        left[0], left[5], left[2], left[6], size.width, size.height, LensModel::none, {}};
    if (!stereo) return calibration;
    const auto right = projection_row(calib_path, cameras.right);
    calibration.baseline_m = offset_to_the_right(right) - offset_to_the_right(left);
    if (!(*calibration.baseline_m > 0))
        throw std::runtime_error("the baseline after " + calib_path + " is " +
                                 std::to_string(*calibration.baseline_m) +
                                 " m, it must be positive; correct it, or give --calib FILE");
    return calibration;
}

/** Both folders number their images alike; a gap in one of them would shift all pairs behind it. */
void add_right_images(const std::string& right_dir, Recording& recording)
{
    const auto right = list_image_folder(right_dir);
    const auto left_dir = fs::path(recording.frames[0].image.path).parent_path().string();
    check_equal_counts(recording.frames.size(), left_dir, right.size(), right_dir);
    for (std::size_t i = 0; i < right.size(); ++i)
    {
        auto& frame = recording.frames[i];
        if (fs::path(frame.image.path).stem() != fs::path(right[i].path).stem())
            throw std::runtime_error(frame.image.path + " has no partner of its name in " +
                                     right_dir + ": " + right[i].path +
                                     " stands in its place; complete both folders");
        frame.right = right[i];
    }
}
}  // namespace

Recording read_kitti_layout(const std::string& folder,
                            const TimestampSource& timestamps,
                            const std::optional<Calibration>& calibration)
{
    const auto cameras = cameras_in(folder);
    const auto left_dir = image_dir(folder, cameras.left);
    const auto right_dir = image_dir(folder, cameras.right);
    const bool stereo = fs::is_directory(right_dir);
    const auto calib_path = (fs::path(folder) / "calib.txt").string();

    auto recording = mono_recording(stamped(list_image_folder(left_dir), folder, timestamps));
    if (calibration)
        recording.calibration = calibration;
    else if (fs::exists(calib_path))
        recording.calibration =
            calibration_from(calib_path, cameras, stereo, recording.frames[0].image);
    if (!stereo) return recording;
    const std::string put_calib = recording.calibration ? "" : "put " + calib_path + " there, or ";
    check_stereo_calibration(
        recording.calibration,
        put_calib + "give the left images alone: --format list --images " + left_dir);
    add_right_images(right_dir, recording);
    return recording;
}

}  // namespace fild
