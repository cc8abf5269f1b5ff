// SPDX-License-Identifier: BSD-3-Clause
#include "folder_entries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

/** Hidden files are not the user's: `._NAME` and `.DS_Store` are macOS's. */
bool is_hidden(const fs::path& path)
{
    return path.filename().string().front() == '.';
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/** The digits from `begin` on, without leading zeros. */
std::string_view number_at(std::string_view name, std::size_t begin)
{
    const auto end = std::min(name.find_first_not_of("0123456789", begin), name.size());
    const auto first = std::min(name.find_first_not_of('0', begin), end);
    return name.substr(first, end - first);
}

/** True when the digits from `begin` on follow a decimal point: 1.25 is less than 1.5. */
bool is_fraction(std::string_view name, std::size_t begin)
{
    return begin >= 2 && name[begin - 1] == '.' && is_digit(name[begin - 2]);
}

/** Whole numbers in names by their value, all else in the order of bytes. */
bool is_before(const std::string& a, const std::string& b)
{
    std::size_t i = 0;
    std::size_t k = 0;
    bool in_fraction = false;
    while (i < a.size() && k < b.size())
    {
        const bool both_digits = is_digit(a[i]) && is_digit(b[k]);
        if (both_digits && !in_fraction) in_fraction = is_fraction(a, i) && is_fraction(b, k);
        if (!both_digits) in_fraction = false;
        if (!both_digits || in_fraction)
        {
            if (a[i] != b[k])
                return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[k]);
            ++i;
            ++k;
            continue;
        }
        const auto x = number_at(a, i);
        const auto y = number_at(b, k);
        if (x.size() != y.size()) return x.size() < y.size();
        if (x != y) return x < y;
        i = std::min(a.find_first_not_of("0123456789", i), a.size());
        k = std::min(b.find_first_not_of("0123456789", k), b.size());
    }
    if (i < a.size() || k < b.size()) return i == a.size();
    return a < b;  // img1 and img01
}

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
        if (entry.is_regular_file() && is_image_name(entry.path()) && !is_hidden(entry.path()))
            paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end(), is_before);
    return paths;
}

std::string example_in(const std::string& folder)
{
    std::string first;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const auto name = entry.path().filename().string();
            !is_hidden(name) && (first.empty() || name < first))
            first = name;
    return first.empty() ? " (it is empty)" : " (it holds " + first + ", for example)";
}

}  // namespace fild
