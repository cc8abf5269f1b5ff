// SPDX-License-Identifier: BSD-3-Clause
#include "app_main.h"
#include "fild/rawlog/image_list.h"
#include "fild/rawlog/image_rawlog.h"

#include <initializer_list>
#include <iostream>
#include <optional>
#include <string>

namespace
{
/** The command line. */
struct AppOptions
{
    std::string images_dir;
    std::optional<std::string> list_path;  ///< instead of `images_dir`
    fild::TimestampSource timestamps;
    std::string calibration_path;  ///< empty: not calibrated
    fild::ImageRawlogRequest request;
};

/** Nothing when --help or --version was all that was asked for.
 *  \throw fild::WrongUsage */
std::optional<AppOptions> parse_command_line(int argc, char** argv)
{
    using Text = TCLAP::ValueArg<std::string>;
    TCLAP::CmdLine command("Writes a rawlog from a folder or a list of images.", ' ', FILD_VERSION);
    Text output("", "output", "The rawlog to write; must not exist yet", true, "", "FILE.rawlog");
    Text images("", "images", "Folder of images, taken by name in byte order", true, "", "DIR");
    Text list("", "list", "List: IMAGE [SECONDS] a line, relative to the list", true, "", "FILE");
    Text stamps("", "timestamps", "File with one number of seconds a line", false, "", "FILE");
    TCLAP::ValueArg<double> rate("", "rate", "Images per second, from time 0", false, 0, "HZ");
    Text calibration(
        "", "calib", "File with: fx fy cx cy width height [k1 k2 p1 p2 [k3]]", false, "", "FILE");
    Text label("", "sensor-label", "Name of the camera", false, "CAMERA1", "NAME");
    TCLAP::SwitchArg embed(
        "", "embed", "Pixels in the rawlog, not in files in FILE_Images/ beside it");
    command.xorAdd(images, list);
    for (TCLAP::Arg* arg :
         std::initializer_list<TCLAP::Arg*>{&embed, &label, &calibration, &rate, &stamps, &output})
        command.add(arg);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;

    AppOptions options;
    options.images_dir = images.getValue();
    if (list.isSet()) options.list_path = list.getValue();
    options.timestamps.file = stamps.getValue();
    if (rate.isSet()) options.timestamps.rate_hz = rate.getValue();
    options.calibration_path = calibration.getValue();
    options.request.rawlog_path = output.getValue();
    options.request.sensor_label = label.getValue();
    options.request.embed = embed.getValue();
    return options;
}

void run(AppOptions options)
{
    const auto listed = options.list_path ? fild::read_image_list(*options.list_path)
                                          : fild::list_image_folder(options.images_dir);
    const auto images = fild::stamp_images(listed, options.timestamps);
    if (!options.calibration_path.empty())
        options.request.camera = fild::read_calibration_file(options.calibration_path);
    const auto summary = fild::write_image_rawlog(images, options.request);
    std::cout << options.request.rawlog_path << ": " << summary.frames << " frames of "
              << summary.images << " images, "
              << (summary.images_dir.empty() ? "embedded" : "in " + summary.images_dir) << "\n";
}

}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("images-to-rawlog", argc, argv, parse_command_line, run);
}
