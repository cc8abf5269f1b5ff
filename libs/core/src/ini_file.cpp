// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/ini_file.h"

#include "did_you_mean.h"
#include "fild/core/words.h"
#include "shortened.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <istream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/** What is wrong with the name of a section or key; empty when nothing is. MRPT looks names up
 * without regard to case, so `Seed` beside `seed` would go unnoticed. */
std::string fault_of_name(const std::string& name)
{
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (std::none_of(name.begin(), name.end(), is_capital)) return "";
    return "'" + shortened(name) + "' has capital letters; all names are in small ones";
}

bool starts_with(const std::string& text, const std::string& prefix)
{
    return text.compare(0, prefix.size(), prefix) == 0;
}

std::string without_comment(const std::string& line)
{
    const auto text = trimmed(line);
    if (starts_with(text, "#") || starts_with(text, ";") || starts_with(text, "//")) return "";
    const auto end =
        std::min({text.find(" //"), text.find("\t//"), text.find(" ;"), text.find("\t;")});
    return trimmed(text.substr(0, end));
}

/** Copies .ini files line by line, each over its base, refusing what does not belong there. */
class StrictCopier
{
 public:
    explicit StrictCopier(mrpt::config::CConfigFileMemory& target) : target_(target) {}

    void copy_file(const std::string& path)
    {
        std::ifstream file(path);
        if (!file || std::filesystem::is_directory(path))
            throw std::runtime_error(
                "cannot read the configuration file " + path +
                "; the shipped ones are in config-ini of the sources, installed in "
                "share/mrpt-fild/config-ini");
        copy_lines(file, path);
    }

    void copy_lines(std::istream& lines, const std::string& path)
    {
        path_ = path;
        std::string line;
        for (bool first = true; std::getline(lines, line); first = false)
            copy(first && starts_with(line, kByteOrderMark) ? line.substr(3) : line);
    }

 private:
    void copy(const std::string& raw_line)
    {
        ++line_number_;
        const auto line = without_comment(raw_line);
        if (line.empty()) return;
        if (line.front() == '[')
            open_section(line);
        else
            copy_key(line);
    }

    void open_section(const std::string& line)
    {
        if (line.back() != ']') fail("'" + shortened(line) + "' lacks its closing bracket");
        section_ = trimmed(line.substr(1, line.size() - 2));
        check_name(section_);
        if (!seen_.insert("[" + section_).second)
            fail("section [" + shortened(section_) + "] stands twice");
    }

    void copy_key(const std::string& line)
    {
        const auto equals = line.find('=');
        if (equals == std::string::npos)
            fail("'" + shortened(line) + "' is neither '[section]' nor 'key = value'");
        const auto key = trimmed(line.substr(0, equals));
        if (section_.empty() && key == "base") return copy_base(trimmed(line.substr(equals + 1)));
        if (section_.empty()) fail("'" + shortened(line) + "' stands before the first [section]");
        check_name(key);
        if (key.empty()) fail("'" + shortened(line) + "' has no key before the '='");
        if (!seen_.insert(section_ + "." + key).second)
            fail("key '" + shortened(key) + "' stands twice in [" + shortened(section_) + "]");
        target_.write(section_, key, trimmed(line.substr(equals + 1)));
    }

    void copy_base(const std::string& name)
    {
        if (is_base_) fail("the base has a base itself; name that one");
        if (!seen_.insert("base").second) fail("'base' stands twice");
        StrictCopier base(target_);
        base.is_base_ = true;
        try
        {
            base.copy_file((std::filesystem::path(path_).parent_path() / name).string());
        }
        catch (const std::runtime_error& e)
        {
            fail(std::string("base: ") + e.what());
        }
    }

    void check_name(const std::string& name) const
    {
        const auto fault = fault_of_name(name);
        if (!fault.empty()) fail(fault);
    }

    [[noreturn]] void fail(const std::string& reason) const
    {
        throw std::runtime_error(path_ + ":" + std::to_string(line_number_) + ": " + reason);
    }

    mrpt::config::CConfigFileMemory& target_;
    bool is_base_ = false;
    std::string path_;
    int line_number_ = 0;
    std::string section_;
    std::set<std::string> seen_;
};

std::string unknown_section(const std::string& name, const std::vector<std::string>& known)
{
    return "unknown section [" + shortened(name) + "]; " + did_you_mean(name, known) +
           "known sections: [" + joined(known, "] [") + "]";
}
}  // namespace

mrpt::config::CConfigFileMemory load_ini_file(const std::string& path)
{
    mrpt::config::CConfigFileMemory config;
    StrictCopier(config).copy_file(path);
    return config;
}

mrpt::config::CConfigFileMemory load_ini_text(std::string_view text, const std::string& name)
{
    mrpt::config::CConfigFileMemory config;
    std::istringstream lines{std::string(text)};
    StrictCopier(config).copy_lines(lines, name);
    return config;
}

void apply_overrides(mrpt::config::CConfigFileMemory& config,
                     const std::vector<std::string>& overrides)
{
    for (const auto& text : overrides)
    {
        const auto equals = text.find('=');
        const auto dot = text.find('.');
        if (equals == std::string::npos || dot == std::string::npos || dot == 0 ||
            dot + 1 >= equals)
            throw std::invalid_argument("'" + shortened(text) +
                                        "' is not of the form section.key=value");
        const auto section = trimmed(text.substr(0, dot));
        const auto key = trimmed(text.substr(dot + 1, equals - dot - 1));
        for (const auto& name : {section, key})
            if (const auto fault = fault_of_name(name); !fault.empty())
                throw std::invalid_argument(fault);
        config.write(section, key, trimmed(text.substr(equals + 1)));
    }
}

void load_sections(const mrpt::config::CConfigFileBase& config,
                   const std::vector<std::pair<std::string, Options*>>& sections,
                   const std::vector<std::string>& passed_over)
{
    std::vector<std::string> known;
    known.reserve(sections.size() + passed_over.size());
    for (const auto& section : sections) known.push_back(section.first);
    known.insert(known.end(), passed_over.begin(), passed_over.end());
    std::vector<std::string> present;
    config.getAllSections(present);
    for (const auto& name : present)
    {
        if (std::count(passed_over.begin(), passed_over.end(), name) > 0) continue;
        const auto matches = [&](const auto& section) { return section.first == name; };
        const auto section = std::find_if(sections.begin(), sections.end(), matches);
        if (section == sections.end()) throw std::runtime_error(unknown_section(name, known));
        section->second->loadFromConfigFile(config, name);
    }
}

}  // namespace fild
