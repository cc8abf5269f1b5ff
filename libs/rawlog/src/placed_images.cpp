// SPDX-License-Identifier: BSD-3-Clause
#include "placed_images.h"

#include "checked_image.h"

#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

void link_or_copy(const fs::path& source, const fs::path& target)
{
    std::error_code error;
    fs::create_hard_link(source, target, error);
    if (!error) return;
    error.clear();
    fs::copy_file(source, target, error);
    if (error)
        throw std::runtime_error("cannot copy " + source.string() +
                                 " beside the rawlog: " + error.message() + "; is the disk full?");
}

PlacedImage external(const std::string& name, cv::Size size)
{
    PlacedImage placed{{}, size};
    placed.image.setExternalStorage(name);
    return placed;
}
}  // namespace

PlacedImages::PlacedImages(const std::optional<fs::path>& folder)
{
    if (folder) folder_.emplace(*folder);
}

PlacedImage PlacedImages::place(const ImageFile& file, const fs::path& name)
{
    std::error_code error;  // a path that leads nowhere is told by load_checked
    const auto source = fs::canonical(file.path, error);
    if (const auto known = known_.find(source.string()); !error && folder_ && known != known_.end())
        return external(known->second.name, known->second.size);
    const auto pixels = load_checked(file);
    const auto placed_name = folder_ ? unused_name(name) : "";
    known_[source.string()] = {placed_name, pixels.size()};
    if (!folder_) return {mrpt::img::CImage(pixels, mrpt::img::SHALLOW_COPY), pixels.size()};
    link_or_copy(source, folder_->location() / placed_name);
    used_names_.insert(placed_name);
    return external(placed_name, pixels.size());
}

std::string PlacedImages::unused_name(const fs::path& wanted) const
{
    auto name = wanted.string();
    for (int number = 2; used_names_.count(name) != 0; ++number)
        name = wanted.stem().string() + "_" + std::to_string(number) + wanted.extension().string();
    return name;
}

void PlacedImages::commit()
{
    if (folder_) folder_->commit();
}

void PlacedImages::keep()
{
    if (folder_) folder_->keep();
}

}  // namespace fild
