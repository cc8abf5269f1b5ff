// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/whole_file.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <filesystem>

namespace
{
using fild::testing::message_of;
using fild::testing::read_text;

TEST(WholeFile, AppearsOnlyOnCommit)
{
    const fild::testing::TemporaryFolder folder;
    const auto path = folder.path("out.csv");
    fild::WholeFile file(path);
    file.stream() << "whole";
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
    EXPECT_EQ(read_text(path), "whole");
    EXPECT_FALSE(std::filesystem::exists(file.temporary_path()));
}

TEST(WholeFile, LeavesTheOldFileWhenNotCommitted)
{
    const fild::testing::TemporaryFolder folder;
    const auto path = folder.path("out.csv");
    fild::testing::write_text(path, "old");
    std::string temporary;
    {
        fild::WholeFile file(path);
        file.stream() << "half";
        temporary = file.temporary_path();
    }
    EXPECT_EQ(read_text(path), "old");
    EXPECT_FALSE(std::filesystem::exists(temporary));
}

TEST(WholeFile, NamesAPathItCannotWrite)
{
    const auto message =
        message_of<std::runtime_error>([] { fild::WholeFile file("no/such/folder/out.csv"); });
    EXPECT_THAT(message, ::testing::HasSubstr("no/such/folder/out.csv"));
}

TEST(WholeFile, ReportsAFailedWrite)
{
    const fild::testing::TemporaryFolder folder;
    fild::WholeFile file(folder.path("out.csv"));
    file.stream() << "text";
    file.stream().setstate(std::ios::badbit);
    EXPECT_THROW(file.commit(), std::runtime_error);
}

TEST(WholeFile, IsHeldByItsWriterUntilItIsWhole)
{
    const fild::testing::TemporaryFolder folder;
    fild::WholeFile file(folder.path("out.csv"));
    fild::remove_unfinished_in(folder.path());
    EXPECT_TRUE(std::filesystem::exists(file.temporary_path()));
    file.commit();
    EXPECT_TRUE(std::filesystem::exists(folder.path("out.csv")));
}

// `split -d big.tar big.tar.part-` makes such names: to remove them destroyed an archive.
TEST(RemoveUnfinished, LeavesWhatOthersNamedAlike)
{
    const fild::testing::TemporaryFolder folder;
    const auto others = {
        "x.part-01", "big.tar.part-00", ".fild-part-1", "a.fild-part-", "a.fild-part-x"};
    for (const auto* name : others) fild::testing::write_text(folder.path(name), "mine");
    fild::remove_unfinished_in(folder.path());
    for (const auto* name : others) EXPECT_TRUE(std::filesystem::exists(folder.path(name))) << name;
}

TEST(RemoveUnfinished, RemovesLeftoversOfOneNameOrOfAll)
{
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("a.csv.fild-part-1"), "half");
    fild::testing::write_text(folder.path("a.csv"), "whole");
    fild::testing::write_text(folder.path("b.csv.fild-part-22"), "half");
    std::filesystem::create_directory(folder.path("a_Images.fild-part-1"));
    fild::testing::write_text(folder.path("a_Images.fild-part-1/0.png"), "half");
    fild::remove_unfinished_of(folder.path("a.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder.path("a.csv.fild-part-1")));
    EXPECT_TRUE(std::filesystem::exists(folder.path("b.csv.fild-part-22")));
    fild::remove_unfinished_in(folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder.path("b.csv.fild-part-22")));
    EXPECT_FALSE(std::filesystem::exists(folder.path("a_Images.fild-part-1")));
    EXPECT_TRUE(std::filesystem::exists(folder.path("a.csv")));
}

TEST(RefuseExisting, NamesWhatIsThere)
{
    const fild::testing::TemporaryFolder folder;
    EXPECT_NO_THROW(fild::refuse_existing(folder.path("new")));
    std::filesystem::create_symlink("nowhere", folder.path("dangling"));
    for (const auto& path : {folder.path(), folder.path("dangling")})
        EXPECT_EQ(message_of<std::runtime_error>([&] { fild::refuse_existing(path); }),
                  path + " exists already; remove it or choose another output");
}

}  // namespace
