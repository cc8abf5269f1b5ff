// SPDX-License-Identifier: BSD-3-Clause
#include "folder_entries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

bool is_image_name(const fs::path& path)
{
    const std::array<const char*, 9> known{
        ".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".pnm", ".bmp", ".tif", ".tiff"};
    auto extension = path.extension().string();
    std::transform(extension.begin(),
                   extension.end(),
                   extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(known.begin(), known.end(), extension) != known.end();
}
}  // namespace

std::vector<std::string> image_paths_in(const std::string& folder)
{
    if (!fs::is_directory(folder))
        throw std::runtime_error("no such folder of images: '" + folder + "'; check the path");
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && is_image_name(entry.path()))
            paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::string example_in(const std::string& folder)
{
    std::string first;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const auto name = entry.path().filename().string(); first.empty() || name < first)
            first = name;
    return first.empty() ? " (it is empty)" : " (it holds " + first + ", for example)";
}

}  // namespace fild
