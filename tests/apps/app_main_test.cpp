// SPDX-License-Identifier: BSD-3-Clause
#include "app_main.h"

#include "message_of.h"

#include <string>
#include <vector>

namespace
{
using fild::testing::message_of;

std::string usage_error(std::vector<std::string> words)
{
    TCLAP::CmdLine command("Writes a list.", ' ', "1");
    TCLAP::ValueArg<std::string> images("", "images", "A folder", true, "", "DIR");
    TCLAP::ValueArg<std::string> list("", "list", "A file", true, "", "FILE");
    command.xorAdd(images, list);
    std::vector<std::string> sizes{"tiny", "large"};
    TCLAP::ValuesConstraint<std::string> any_size(sizes);
    const TCLAP::ValueArg<std::string> size("s", "size", "", false, "tiny", &any_size, command);
    const TCLAP::ValueArg<std::string> output("", "output", "A file", true, "", "FILE", command);
    words.insert(words.begin(), "app");
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return message_of<fild::WrongUsage>(
        [&]
        { fild::parse_arguments(command, static_cast<int>(arguments.size()), arguments.data()); });
}

TEST(ParseArguments, NamesWhatIsMissingAndItsAlternatives)
{
    EXPECT_EQ(usage_error({}), "missing: --images or --list, --output");
    EXPECT_EQ(usage_error({"--output", "a"}), "missing: --images or --list");
    EXPECT_EQ(usage_error({"--list", "a"}), "missing: --output");
}

TEST(ParseArguments, NamesWhatItDoesNotKnowAndWhatIsGivenTwice)
{
    EXPECT_EQ(usage_error({"--bogus"}), "unknown argument: --bogus");
    EXPECT_EQ(usage_error({"-b"}), "unknown argument: -b");
    EXPECT_EQ(usage_error({"one-more"}), "unknown argument: one-more");
    EXPECT_EQ(usage_error({"--output", "a", "--output", "b"}), "given twice: --output");
    EXPECT_EQ(usage_error({"-s", "tiny", "--size", "tiny"}), "given twice: --size");
    EXPECT_EQ(usage_error({"-s", "tyni"}), "'tyni' is not one of tiny|large: --size");
}

}  // namespace
