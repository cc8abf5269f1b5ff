// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_file.h"

#include "drawn_rawlog.h"
#include "message_of.h"

#include <opencv2/imgcodecs.hpp>

namespace
{
using namespace fild::testing;
using fild::read_image_file;

TEST(ReadImageFile, KeepsDepthAndChannels)
{
    const TemporaryFolder folder;
    for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1})
    {
        const auto image = draw_image(type);
        cv::imwrite(folder.path("a.png"), image);
        const auto read = read_image_file(folder.path("a.png"));
        ASSERT_TRUE(read) << type;
        ASSERT_EQ(read->type(), type);
        EXPECT_EQ(cv::norm(*read, image, cv::NORM_INF), 0);
    }
}

TEST(ReadImageFile, GivesNothingForWhatIsNoImage)
{
    const TemporaryFolder folder;
    write_text(folder.path("empty.png"), "");
    write_text(folder.path("text.png"), "not an image");
    EXPECT_FALSE(read_image_file(folder.path("none.png")));
    EXPECT_FALSE(read_image_file(folder.path("empty.png")));
    EXPECT_FALSE(read_image_file(folder.path("text.png")));
    EXPECT_FALSE(read_image_file(folder.path()));
}

TEST(ReadImageFile, GivesNothingForAFileCutOffAnywhere)
{
    const TemporaryFolder folder;
    for (const std::string name : {"a.jpg", "a.png", "a.ppm", "a.bmp"})
    {
        cv::Mat noise(48, 64, CV_8UC3);
        cv::randu(noise, 0, 255);
        cv::imwrite(folder.path(name), noise);
        const auto whole = read_text(folder.path(name));
        EXPECT_TRUE(read_image_file(folder.path(name))) << name;
        for (std::size_t length = 1; length + 20 < whole.size(); length += whole.size() / 50)
        {
            write_text(folder.path("cut-" + name), whole.substr(0, length));
            EXPECT_FALSE(read_image_file(folder.path("cut-" + name))) << name << " " << length;
        }
    }
}

TEST(ReadImageFile, TakesAJpegWithAnythingBehindItsEnd)
{
    const TemporaryFolder folder;
    cv::imwrite(folder.path("a.jpg"), draw_image());
    const auto image = read_text(folder.path("a.jpg"));
    const auto cut_thumbnail = image.substr(0, image.size() - 100);
    for (const auto& behind : {std::string(1000, '\0'), cut_thumbnail, std::string("\xFF\xDA\xFF")})
    {
        write_text(folder.path("padded.jpg"), image + behind);
        EXPECT_TRUE(read_image_file(folder.path("padded.jpg")));
    }
}

TEST(ReadImageFile, IsNotMisledByAThumbnailInAJpegThatIsCutOff)
{
    const TemporaryFolder folder;
    cv::imwrite(folder.path("a.jpg"), draw_image());
    const auto image = read_text(folder.path("a.jpg"));
    const auto length = image.size() + 2;
    const std::string segment = {
        '\xFF', '\xE1', static_cast<char>(length >> 8U), static_cast<char>(length & 0xFFU)};
    const auto with_thumbnail = image.substr(0, 2) + segment + image + image.substr(2);
    write_text(folder.path("whole.jpg"), with_thumbnail);
    EXPECT_TRUE(read_image_file(folder.path("whole.jpg")));
    write_text(folder.path("cut.jpg"), with_thumbnail.substr(0, with_thumbnail.size() - 40));
    EXPECT_FALSE(read_image_file(folder.path("cut.jpg")));
}

TEST(ReadImageFile, GivesNothingForAHeaderThatAsksForTooMuch)
{
    const TemporaryFolder folder;
    write_text(folder.path("huge.pgm"), "P5\n900000 900000\n255\nabc");
    EXPECT_FALSE(read_image_file(folder.path("huge.pgm")));
}

TEST(ReadImageFile, GivesNothingBeyondItsLimit)
{
    const TemporaryFolder folder;
    for (const auto* name : {"large.jpg", "large.png"})
    {
        cv::imwrite(folder.path(name), draw_image(CV_8UC3, 0, {1000, 500}));  // 1.5 MB
        EXPECT_FALSE(read_image_file(folder.path(name), 1)) << name;
        EXPECT_TRUE(read_image_file(folder.path(name), 2)) << name;
    }
    write_text(folder.path("text.pgm"), "P5\n1 1\n255\n" + std::string(1U << 20U, 'a'));
    EXPECT_FALSE(read_image_file(folder.path("text.pgm"), 1));
    EXPECT_TRUE(read_image_file(folder.path("text.pgm"), 2));
}

/** What decoding a file prints, by whichever library. */
std::string printed_while_reading(const std::string& path)
{
    testing::internal::CaptureStderr();
    read_image_file(path);
    return testing::internal::GetCapturedStderr();
}

/** A PNG with a chunk behind its header that libpng warns about: a gamma of 0. */
std::string with_wrong_gamma(const std::string& png)
{
    constexpr std::size_t kHeaderEnd = 8 + 25;
    const std::string length_and_name = {'\0', '\0', '\0', '\4', 'g', 'A', 'M', 'A'};
    const std::string gamma_and_checksum = {'\0', '\0', '\0', '\0', '\x8B', '\x25', '\x60', '\x4D'};
    return png.substr(0, kHeaderEnd) + length_and_name + gamma_and_checksum +
           png.substr(kHeaderEnd);
}

TEST(ReadImageFile, KeepsWhatDecodersSayOfADamagedImage)
{
    const TemporaryFolder folder;
    cv::Mat noise(48, 64, CV_8UC1);
    cv::randu(noise, 0, 255);
    cv::imwrite(folder.path("a.png"), noise);
    cv::imwrite(folder.path("a.jpg"), noise);
    auto damaged = read_text(folder.path("a.png"));
    write_text(folder.path("gamma.png"), with_wrong_gamma(damaged));
    damaged[damaged.size() / 2] ^= '\1';
    write_text(folder.path("checksum.png"), damaged);
    auto jpeg = read_text(folder.path("a.jpg"));
    jpeg.replace(jpeg.size() / 2, 40, 40, '\x7F');
    write_text(folder.path("damaged.jpg"), jpeg);
    write_text(folder.path("no_size.pgm"), "P5\n0 0\n255\nabc");
    EXPECT_TRUE(read_image_file(folder.path("gamma.png")));
    EXPECT_FALSE(read_image_file(folder.path("checksum.png")));
    for (const auto* name : {"gamma.png", "checksum.png", "damaged.jpg", "no_size.pgm"})
        EXPECT_EQ(printed_while_reading(folder.path(name)), "") << name;
}

}  // namespace
