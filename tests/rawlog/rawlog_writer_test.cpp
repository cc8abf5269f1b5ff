// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/rawlog_writer.h"

#include "drawn_rawlog.h"
#include "fild/rawlog/rawlog_reader.h"
#include "message_of.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <csignal>
#include <sys/resource.h>

namespace
{
using namespace fild::testing;
using ::testing::HasSubstr;

/** Makes files longer than some bytes fail to write, as a full disk does. */
class FileSizeLimit
{
 public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        auto limit = before_;
        limit.rlim_cur = bytes;
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

 private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

std::size_t files_in(const TemporaryFolder& folder)
{
    const std::filesystem::directory_iterator entries(folder.path());
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

TEST(RawlogWriter, WritesActionsAndSensoryFrames)
{
    const TemporaryFolder folder;
    const auto path = folder.path("out.rawlog");
    fild::RawlogWriter writer(path);
    for (const double seconds : {1.0, 2.0})
    {
        mrpt::obs::CSensoryFrame frame;
        frame.insert(image_observation(draw_image(), seconds));
        writer.write(mrpt::obs::CActionCollection(), frame);
    }
    writer.commit();
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path));
    ASSERT_EQ(rawlog.size(), 4U);
    EXPECT_EQ(rawlog.getType(0), mrpt::obs::CRawlog::etActionCollection);
    EXPECT_EQ(rawlog.getType(1), mrpt::obs::CRawlog::etSensoryFrame);
    fild::RawlogReader reader(path);
    EXPECT_EQ(mrpt::Clock::toDouble(reader.next()->timestamp), 1);
    EXPECT_EQ(mrpt::Clock::toDouble(reader.next()->timestamp), 2);
    EXPECT_FALSE(reader.next());
}

TEST(RawlogWriter, WritesWhatTheReaderReads)
{
    const TemporaryFolder folder;
    const auto path = folder.path("out.rawlog");
    fild::RawlogWriter writer(path);
    const auto image = draw_image(CV_8UC3);
    writer.write(*image_observation(image, 12.25, "EYE"));
    EXPECT_FALSE(std::filesystem::exists(path)) << "not before it is whole";
    writer.commit();
    fild::RawlogReader reader(path);
    const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(reader.next());
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->sensorLabel, "EYE");
    EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(read->timestamp), 12.25);
    EXPECT_EQ(cv::norm(read->image.asCvMatRef(), image, cv::NORM_INF), 0) << "without loss";
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(files_in(folder), 1U);
}

TEST(RawlogWriter, LeavesNothingWithoutCommit)
{
    const TemporaryFolder folder;
    {
        fild::RawlogWriter writer(folder.path("out.rawlog"));
        writer.write(*image_observation(draw_image(), 0));
    }
    EXPECT_EQ(files_in(folder), 0U);
}

TEST(RawlogWriter, SaysThatTheDiskIsFull)
{
    cv::Mat noise(480, 640, CV_8UC3);
    cv::randu(noise, 0, 255);
    const TemporaryFolder folder;
    const FileSizeLimit limit(100'000);
    const auto message = message_of<std::runtime_error>(
        [&]
        {
            fild::RawlogWriter writer(folder.path("out.rawlog"));
            writer.write(*image_observation(noise, 0));
            writer.commit();
        });
    EXPECT_THAT(message, HasSubstr("out.rawlog"));
    EXPECT_THAT(message, HasSubstr("disk full"));
    EXPECT_EQ(files_in(folder), 0U);
}

TEST(RawlogWriter, NamesAFolderThatIsNotThere)
{
    const auto message = message_of<std::runtime_error>(
        [] { fild::RawlogWriter writer("/nowhere/at/all/out.rawlog"); });
    EXPECT_THAT(message, HasSubstr("/nowhere/at/all/out.rawlog"));
}

}  // namespace
