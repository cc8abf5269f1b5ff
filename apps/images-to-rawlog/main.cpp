// SPDX-License-Identifier: BSD-3-Clause
#include "app_main.h"
#include "fild/rawlog/image_layouts.h"
#include "fild/rawlog/image_rawlog.h"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace
{
/** The command line. */
struct AppOptions
{
    fild::LayoutRequest input;
    fild::ImageRawlogRequest output;
    bool quiet = false;
};

std::vector<std::string> format_words()
{
    std::vector<std::string> words;
    for (const auto& [word, layout] : fild::layout_words()) words.push_back(word);
    return words;
}

/** An option that need not be given. */
template <class Value>
class OptionalArg
{
 public:
    OptionalArg(TCLAP::CmdLine& command,
                const std::string& name,
                const std::string& description,
                const std::string& placeholder)
        : arg_("", name, description, false, Value{}, placeholder, command)
    {
    }

    std::optional<Value> get()
    {
        return arg_.isSet() ? std::make_optional(arg_.getValue()) : std::nullopt;
    }

 private:
    TCLAP::ValueArg<Value> arg_;
};

/** Nothing when --help or --version was all that was asked for.
 *  \throw fild::WrongUsage */
std::optional<AppOptions> parse_command_line(int argc, char** argv)
{
    using Text = TCLAP::ValueArg<std::string>;
    using OptionalText = OptionalArg<std::string>;
    TCLAP::CmdLine command("Writes a rawlog from images on disk.", ' ', FILD_VERSION);
    // TCLAP's help shows the options from the last to the first.
    TCLAP::SwitchArg quiet("q", "quiet", "Print nothing unless something fails", command);
    TCLAP::SwitchArg embed("", "embed", "Pixels in the rawlog, not in NAME_Images/", command);
    OptionalText label(command, "sensor-label", "Name of the camera: CAMERA1", "NAME");
    OptionalArg<double> scale(
        command, "depth-scale", "Depth units per metre: 1000, tum: 5000", "S");
    OptionalText depth(command, "depth", "Folder of 16-bit depth, paired by order", "DIR");
    OptionalText right(command, "right", "Folder of right images, for --format stereo", "DIR");
    OptionalText calibration(command,
                             "calib",
                             "File: fx fy cx cy width height [k1 k2 p1 p2 [k3]]; "
                             "stereo: further lines, see the README",
                             "FILE");
    OptionalArg<double> rate(command, "rate", "Images per second, from time 0", "HZ");
    Text stamps(
        "", "timestamps", "File with one number of seconds a line", false, "", "FILE", command);
    auto words = format_words();
    TCLAP::ValuesConstraint<std::string> formats(words);
    Text format("", "format", "Layout of the recording on disk", false, "list", &formats, command);
    Text output("", "output", "To write; must not exist yet", true, "", "NAME.rawlog", command);
    Text images("", "images", "Folder of images or of the format's sequence", true, "", "DIR");
    Text list("", "list", "List: IMAGE [SECONDS] a line, relative to the list", true, "", "FILE");
    command.xorAdd(images, list);
    if (!fild::parse_arguments(command, argc, argv)) return std::nullopt;

    AppOptions options;
    options.input.layout = fild::layout_named(format.getValue());
    options.input.images_dir = images.getValue();
    if (list.isSet()) options.input.list_path = list.getValue();
    options.input.timestamps = {stamps.getValue(), rate.get()};
    options.input.calibration_path = calibration.get();
    options.input.right_dir = right.get();
    options.input.depth_dir = depth.get();
    options.input.depth_units_per_metre = scale.get();
    options.quiet = quiet.getValue();
    options.output = {output.getValue(), label.get(), embed.getValue()};
    return options;
}

void run(const AppOptions& options)
{
    const auto recording = fild::as_usage([&] { return fild::read_recording(options.input); });
    const auto summary =
        fild::as_usage([&] { return fild::write_image_rawlog(recording, options.output); });
    if (options.quiet) return;
    std::cout << options.output.rawlog_path << ": " << summary_text(summary) << "\n";
    for (const auto& what : recording.left_out) std::cout << "left out: " << what << "\n";
}

}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("images-to-rawlog", argc, argv, parse_command_line, run);
}
