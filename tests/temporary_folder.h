// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>

namespace fild::testing
{
/** A folder of its own for one test, removed with all it holds when the test ends. */
class TemporaryFolder
{
 public:
    TemporaryFolder()
    {
        auto pattern = (std::filesystem::temp_directory_path() / "fild-test-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr)
            throw std::runtime_error("cannot make a temporary folder");
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;  // a leftover in the temporary folder harms nobody
        std::filesystem::remove_all(path_, ignored);
    }

    std::string path(const std::string& name = "") const { return (path_ / name).string(); }

 private:
    std::filesystem::path path_;
};

inline void write_text(const std::string& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace fild::testing
