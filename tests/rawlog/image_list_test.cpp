// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_list.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::ListedImage;
using fild::TimestampSource;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<ListedImage> images(std::size_t count)
{
    std::vector<ListedImage> list;
    for (std::size_t i = 0; i < count; ++i)
        list.push_back({{"i" + std::to_string(i), "list line " + std::to_string(i + 1)}, {}});
    return list;
}

std::vector<ListedImage> read(const std::string& text)
{
    const TemporaryFolder folder;
    write_text(folder.path("list.txt"), text);
    auto list = fild::read_image_list(folder.path("list.txt"));
    for (auto& image : list)  // independent of where the temporary folder is
        if (image.path.rfind(folder.path(), 0) == 0) image.path.erase(0, folder.path().size());
    return list;
}

std::string read_error(const std::string& text)
{
    return message_of<std::runtime_error>([&] { read(text); });
}

std::vector<double> stamps_from(const std::string& file_text, std::size_t count)
{
    const TemporaryFolder folder;
    write_text(folder.path("times.txt"), file_text);
    std::vector<double> seconds;
    for (const auto& image : fild::stamp_images(images(count), {folder.path("times.txt"), {}}))
        seconds.push_back(image.seconds);
    return seconds;
}

std::string stamps_error(const std::string& file_text, std::size_t count)
{
    return message_of<std::runtime_error>([&] { stamps_from(file_text, count); });
}

TEST(ImageFolder, ListsImagesByNameAndPassesOverTheRest)
{
    const TemporaryFolder folder;
    for (const auto* name : {"img2.png",
                             "img10.PNG",
                             "a.JPeG",
                             "x.tiff",
                             "notes.txt",
                             "png",
                             "._img2.png",
                             ".hidden.jpg",
                             ".DS_Store"})
        write_text(folder.path(name), "");
    std::filesystem::create_directory(folder.path("sub.png"));
    std::vector<std::string> names;
    for (const auto& image : fild::list_image_folder(folder.path()))
        names.push_back(std::filesystem::path(image.path).filename().string());
    EXPECT_THAT(names, ElementsAre("a.JPeG", "img2.png", "img10.PNG", "x.tiff"));
}

TEST(ImageFolder, OrdersWholeNumbersByTheirValue)
{
    const std::vector<std::string> ordered = {"0_b2.png",
                                              "0_b10.png",
                                              "1.25.png",
                                              "1.5.png",
                                              "2.05.png",
                                              "7.png",
                                              "007a.png",
                                              "10.125.png",
                                              "10.png",
                                              "18446744073709551617.png",
                                              "a1b2.png",
                                              "a1b10.png",
                                              "a01b11.png",
                                              "b.png",
                                              "b1.png"};
    const TemporaryFolder folder;
    for (const auto& name : ordered) write_text(folder.path(name), "");
    std::vector<std::string> names;
    for (const auto& image : fild::list_image_folder(folder.path()))
        names.push_back(std::filesystem::path(image.path).filename().string());
    EXPECT_EQ(names, ordered);
}

TEST(ImageFolder, SaysThatAFolderOfHiddenFilesHoldsNoImage)
{
    const TemporaryFolder folder;
    write_text(folder.path("._a.png"), "");
    EXPECT_THAT(message_of<std::runtime_error>([&] { fild::list_image_folder(folder.path()); }),
                AllOf(HasSubstr("no image in"), Not(HasSubstr("._a.png"))));
}

TEST(ImageFolder, NamesAMissingAndAnEmptyFolder)
{
    const TemporaryFolder folder;
    const auto error = [](const std::string& path)
    { return message_of<std::runtime_error>([&] { fild::list_image_folder(path); }); };
    EXPECT_THAT(error(folder.path("none")), HasSubstr("no such folder"));
    EXPECT_THAT(error(folder.path()), AllOf(HasSubstr("no image in"), HasSubstr(".png")));
}

TEST(ImageList, ReadsNamesWithAndWithoutTimes)
{
    const auto plain = read("# a comment\n\n  b.png \r\nsub/a.png\nb.png\n/abs/c.png\n");
    ASSERT_EQ(plain.size(), 4U);
    EXPECT_EQ(plain[0].path, "b.png");
    EXPECT_THAT(plain[0].origin, HasSubstr("list.txt line 3"));
    EXPECT_EQ(plain[1].path, "sub/a.png");
    EXPECT_EQ(plain[3].path, "/abs/c.png");
    EXPECT_FALSE(plain[0].seconds);
    const auto timed = read("a.png 0\nb.png\t 1.5e0\n");
    EXPECT_EQ(timed[1].path, "b.png");
    EXPECT_DOUBLE_EQ(*timed[1].seconds, 1.5);
}

TEST(ImageList, KeepsBlanksInNames)
{
    EXPECT_EQ(read("my photo.png\n")[0].path, "my photo.png");
    EXPECT_FALSE(read("IMG 0001.png\n")[0].seconds);
    const auto timed = read("my photo.png 2.5\n");
    EXPECT_EQ(timed[0].path, "my photo.png");
    EXPECT_DOUBLE_EQ(*timed[0].seconds, 2.5);
    EXPECT_EQ(read("1234.5\n")[0].path, "1234.5") << "one word is always a name";
}

TEST(ImageList, SaysWhatIsWrong)
{
    EXPECT_THAT(read_error("a.png 1\nb.png\n"), AllOf(HasSubstr("line 2"), HasSubstr("line 1")));
    EXPECT_THAT(read_error(""), HasSubstr("no image in list"));
    EXPECT_THAT(read_error("# only\n"), HasSubstr("no image in list"));
    EXPECT_THAT(read_error(std::string("a\0b", 3)), HasSubstr("not a text file"));
    const auto missing =
        message_of<std::runtime_error>([] { fild::read_image_list("/nowhere/list.txt"); });
    EXPECT_THAT(missing, AllOf(HasSubstr("/nowhere/list.txt"), HasSubstr("No such file")));
    EXPECT_THROW(fild::read_image_list("/tmp"), std::runtime_error);
}

TEST(StampImages, TakesTimesFromAFileOrARate)
{
    EXPECT_THAT(stamps_from("# t\n0\n0.1\n\n0.2\n", 3), ElementsAre(0, 0.1, 0.2));
    EXPECT_THAT(stamps_from("1403636579.763555584\n1403636579.81355\n", 2).size(), 2U);
    const auto at_rate = fild::stamp_images(images(3), {"", 10.0});
    EXPECT_DOUBLE_EQ(at_rate[2].seconds, 0.2);
    EXPECT_EQ(at_rate[2].path, "i2");
}

TEST(StampImages, TakesTimesFromTheList)
{
    auto list = images(2);
    list[0].seconds = 3;
    list[1].seconds = 4;
    EXPECT_DOUBLE_EQ(fild::stamp_images(list, {})[1].seconds, 4);
    EXPECT_THROW(fild::stamp_images(list, {"", 10.0}), std::invalid_argument);
}

TEST(StampImages, NeedsExactlyOneSource)
{
    const auto error = [](const TimestampSource& source)
    { return message_of<std::invalid_argument>([&] { fild::stamp_images(images(2), source); }); };
    EXPECT_THAT(error({}), AllOf(HasSubstr("no time stamps"), HasSubstr("--rate")));
    EXPECT_THAT(error({"times.txt", 1.0}), HasSubstr("several sources"));
    EXPECT_THAT(error({"", 0.0}), HasSubstr("rate"));
    EXPECT_THAT(error({"", -1.0}), HasSubstr("rate"));
    EXPECT_THAT(error({"", std::nan("")}), HasSubstr("rate"));
    EXPECT_THAT(error({"", 1e9}), HasSubstr("rate"));
}

TEST(StampImages, WantsTimesThatGrow)
{
    for (const auto* times : {"0\n1\n1\n", "0\n2\n1\n", "0\n1\n1.0000000001\n"})
        EXPECT_THAT(stamps_error(times, 3),
                    AllOf(HasSubstr("times.txt line 3"), HasSubstr("times.txt line 2")));
    EXPECT_NO_THROW(stamps_from("1e9\n1000000000.000001\n", 2)) << "a microsecond is enough";
    EXPECT_NO_THROW(fild::stamp_images(images(50), {"", 1e6}));
}

TEST(StampImages, WantsSecondsAndOneForEachImage)
{
    EXPECT_THAT(stamps_error("0\n1\n", 3), AllOf(HasSubstr("2 times"), HasSubstr("3 images")));
    EXPECT_THAT(stamps_error("0\n1\n2\n", 2), HasSubstr("3 times"));
    EXPECT_THAT(stamps_error("0\n1s\n", 2), AllOf(HasSubstr("line 2"), HasSubstr("'1s'")));
    EXPECT_THAT(stamps_error("0\nnan\n", 2), HasSubstr("'nan'"));
    EXPECT_THAT(stamps_error("-1\n", 1), HasSubstr("outside"));
    EXPECT_THAT(stamps_error("1403636579763555584\n", 1), HasSubstr("another unit"));
}

}  // namespace
