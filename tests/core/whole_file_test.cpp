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
