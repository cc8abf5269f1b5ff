// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/rawlog_reader.h"

#include "drawn_rawlog.h"
#include "fild/core/whole_file.h"
#include "message_of.h"

#include <mrpt/math/TPose3D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>

#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
using namespace fild::testing;
using fild::RawlogReader;
using fild::TruncatedRawlog;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> labels_in(const std::string& path)
{
    RawlogReader reader(path);
    std::vector<std::string> labels;
    while (const auto observation = reader.next()) labels.push_back(observation->sensorLabel);
    EXPECT_EQ(reader.next(), nullptr) << "the end stays the end";
    EXPECT_DOUBLE_EQ(reader.fraction_read(), 1.0);
    return labels;
}

std::string open_error(const std::string& path)
{
    return message_of<std::runtime_error>([&] { RawlogReader reader(path); });
}

Objects three_observations()
{
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->sensorLabel = "WHEELS";
    return {image_observation(draw_image(), 1, "LEFT"),
            odometry,
            image_observation(draw_image(CV_8UC3), 2, "RIGHT")};
}

Objects action_and_frames()
{
    auto first = mrpt::obs::CSensoryFrame::Create();
    first->insert(image_observation(draw_image(), 1, "A"));
    first->insert(image_observation(draw_image(), 1, "B"));
    auto second = mrpt::obs::CSensoryFrame::Create();
    second->insert(image_observation(draw_image(), 2, "C"));
    const auto empty = mrpt::obs::CSensoryFrame::Create();
    return {mrpt::obs::CActionCollection::Create(),
            first,
            empty,
            mrpt::obs::CActionCollection::Create(),
            second};
}

TEST(RawlogReader, GivesObservationsInOrderPlainAndGzipped)
{
    const TemporaryFolder folder;
    write_plain(folder.path("plain.rawlog"), three_observations());
    write_gz(folder.path("gz.rawlog"), three_observations());
    EXPECT_THAT(labels_in(folder.path("plain.rawlog")), ElementsAre("LEFT", "WHEELS", "RIGHT"));
    EXPECT_THAT(labels_in(folder.path("gz.rawlog")), ElementsAre("LEFT", "WHEELS", "RIGHT"));
}

TEST(RawlogReader, KeepsWhatDecodersSayOfADamagedImage)
{
    const TemporaryFolder folder;
    cv::Mat noise(120, 160, CV_8UC3);
    cv::randu(noise, 0, 255);
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);  // as MRPT's recorders do
    write_plain(folder.path("a.rawlog"), {image_observation(noise, 1)});
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
    auto bytes = read_text(folder.path("a.rawlog"));
    ASSERT_NE(bytes.find("JFIF"), std::string::npos) << bytes.size();
    bytes.replace(bytes.size() / 2, 40, 40, '\x7F');
    write_text(folder.path("a.rawlog"), bytes);
    testing::internal::CaptureStderr();
    EXPECT_THAT(labels_in(folder.path("a.rawlog")), ElementsAre("CAMERA1"));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(RawlogReader, UnpacksSensoryFramesAndPassesOverActions)
{
    const TemporaryFolder folder;
    write_gz(folder.path("frames.rawlog"), action_and_frames());
    EXPECT_THAT(labels_in(folder.path("frames.rawlog")), ElementsAre("A", "B", "C"));
}

TEST(RawlogReader, GivesActionsAtTheirPlaceToWhoAsksForEntries)
{
    const TemporaryFolder folder;
    write_gz(folder.path("frames.rawlog"), action_and_frames());
    RawlogReader reader(folder.path("frames.rawlog"));
    std::string kinds;
    for (auto entry = reader.next_entry(); entry.observation || entry.actions;
         entry = reader.next_entry())
        kinds += entry.actions ? "-" : entry.observation->sensorLabel;
    EXPECT_EQ(kinds, "-AB-C");
    EXPECT_EQ(reader.next(), nullptr);
}

TEST(RawlogReader, ReadsOneSerializedRawlogObject)
{
    auto rawlog = mrpt::obs::CRawlog::Create();
    rawlog->setCommentText("a comment");
    mrpt::obs::CSensoryFrame frame;
    frame.insert(image_observation(draw_image(), 1, "A"));
    rawlog->insert(frame);
    const TemporaryFolder folder;
    write_gz(folder.path("object.rawlog"), {rawlog});
    EXPECT_THAT(labels_in(folder.path("object.rawlog")), ElementsAre("A"));
}

TEST(RawlogReader, TellsHowFarItIs)
{
    Objects many;
    cv::Mat noise(480, 640, CV_8UC1);
    cv::randu(noise, 0, 255);
    for (int i = 0; i < 10; ++i) many.push_back(image_observation(noise, i));
    const TemporaryFolder folder;
    write_gz(folder.path("many.rawlog"), many);
    RawlogReader reader(folder.path("many.rawlog"));
    double previous = reader.fraction_read();
    EXPECT_LT(previous, 0.3);
    while (reader.next())
    {
        EXPECT_GE(reader.fraction_read(), previous);
        previous = reader.fraction_read();
    }
}

TEST(RawlogReader, NamesAMissingFileAFolderAndAnEmptyFile)
{
    const TemporaryFolder folder;
    EXPECT_THAT(open_error(folder.path("none.rawlog")),
                AllOf(HasSubstr("no such rawlog"), HasSubstr("none.rawlog")));
    EXPECT_THAT(open_error(folder.path()), HasSubstr("is no file"));
    write_text(folder.path("empty.rawlog"), "");
    EXPECT_THAT(open_error(folder.path("empty.rawlog")), HasSubstr("empty (0 bytes)"));
}

TEST(RawlogReader, SaysWhatAFileIsThatIsNoRawlog)
{
    const TemporaryFolder folder;
    const auto error_of = [&](const std::string& content)
    {
        write_text(folder.path("x.rawlog"), content);
        return open_error(folder.path("x.rawlog"));
    };
    EXPECT_THAT(error_of("hello, this is text\n"), HasSubstr("no rawlog but a text file"));
    EXPECT_THAT(error_of("x"), HasSubstr("no rawlog but a text file"));
    EXPECT_THAT(error_of("\x89PNG\r\n\x1a\n"), HasSubstr("a PNG image"));
    EXPECT_THAT(error_of("\xFF\xD8\xFF\xE0 JFIF"), HasSubstr("a JPEG image"));
    EXPECT_THAT(error_of("#ROSBAG V2.0\n"), HasSubstr("a ROS bag"));
    EXPECT_THAT(error_of(std::string(300, '\0')), HasSubstr("is no rawlog"));
    EXPECT_THAT(error_of(std::string(300, '\xFF')), HasSubstr("is no rawlog"));
}

TEST(RawlogReader, RefusesAFileWithAnotherObjectOfMrpt)
{
    const TemporaryFolder folder;
    write_gz(folder.path("pose.rawlog"), {mrpt::poses::CPose3D::Create()});
    EXPECT_THAT(open_error(folder.path("pose.rawlog")), HasSubstr("CPose3D"));
}

/** A class of another program, as a newer MRPT may have a class that this one does not know. */
TEST(RawlogReader, NamesAClassItDoesNotKnow)
{
    const TemporaryFolder folder;
    const auto path = folder.path("foreign.rawlog");
    write_plain(path, three_observations());
    write_text(path, read_text(path) + "\x8C" + "CAlienObject" + std::string(20, '\0'));
    RawlogReader reader(path);
    for (int i = 0; i < 3; ++i) EXPECT_NE(reader.next(), nullptr);
    const auto message = message_of<TruncatedRawlog>([&] { reader.next(); });
    EXPECT_THAT(message,
                AllOf(HasSubstr("cannot be read further after 3 entries"),
                      HasSubstr("does not know CAlienObject, which a newer MRPT writes"),
                      HasSubstr("rawlog-edit"),
                      Not(HasSubstr("\n"))));
}

/** Of an observation by itself, and of one in a frame. */
TEST(RawlogReader, NamesAVersionThatANewerMrptWrites)
{
    const auto odometry = mrpt::obs::CObservationOdometry::Create();
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(odometry);
    const TemporaryFolder folder;
    const auto path = folder.path("newer.rawlog");
    for (const mrpt::serialization::CSerializable::Ptr& object : Objects{odometry, frame})
    {
        write_plain(path, {three_observations()[0], object});
        auto bytes = read_text(path);
        const std::string name = "mrpt::obs::CObservationOdometry";
        bytes.at(bytes.find(name) + name.size()) = 77;
        write_text(path, bytes);
        RawlogReader reader(path);
        EXPECT_NE(reader.next(), nullptr);
        EXPECT_THAT(message_of<TruncatedRawlog>([&] { reader.next(); }),
                    AllOf(HasSubstr("cannot be read further after 1 entry,"),
                          HasSubstr("does not know " + name + " of version 77, which a newer MRPT"),
                          Not(HasSubstr("damaged after"))));
    }
}

TEST(RawlogReader, NamesAVersionOfRawlogObjectsThatANewerMrptWrites)
{
    const TemporaryFolder folder;
    const auto path = folder.path("newer.rawlog");
    write_plain(path, {mrpt::obs::CRawlog::Create()});
    auto bytes = read_text(path);
    bytes.at(bytes.find("CRawlog") + 7) = 9;
    write_text(path, bytes);
    RawlogReader reader(path);
    EXPECT_THAT(message_of<TruncatedRawlog>([&] { reader.next(); }),
                HasSubstr("does not know mrpt::obs::CRawlog of version 9, which a newer MRPT"));
}

/** How many observations a file gives before its clean end, or before TruncatedRawlog. */
struct Reading
{
    std::size_t observations = 0;
    bool truncated = false;
};

Reading read_all(const std::string& path)
{
    Reading reading;
    try
    {
        RawlogReader reader(path);
        while (reader.next()) ++reading.observations;
    }
    catch (const TruncatedRawlog& error)
    {
        EXPECT_EQ(error.entries_read, reading.observations);
        EXPECT_THAT(error.what(), HasSubstr(path));
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        EXPECT_THAT(error.what(),
                    ::testing::AnyOf(HasSubstr("the file ends inside an entry"),
                                     HasSubstr("the compressed data is cut off")));
        reading.truncated = true;
    }
    return reading;
}

TEST(RawlogReader, GivesTheGoodPartOfAPlainRawlogCutOffAnywhere)
{
    const TemporaryFolder folder;
    std::vector<std::size_t> ends{0};
    Objects objects;
    for (const auto& object : three_observations())
    {
        objects.push_back(object);
        write_plain(folder.path("whole.rawlog"), objects);
        ends.push_back(read_text(folder.path("whole.rawlog")).size());
    }
    const auto whole = read_text(folder.path("whole.rawlog"));
    for (std::size_t length = 40; length < whole.size(); length += 211)
    {
        write_text(folder.path("cut.rawlog"), whole.substr(0, length));
        const auto reading = read_all(folder.path("cut.rawlog"));
        const auto complete = std::upper_bound(ends.begin(), ends.end(), length) - ends.begin() - 1;
        EXPECT_EQ(reading.observations, static_cast<std::size_t>(complete)) << length;
        EXPECT_TRUE(reading.truncated || length == ends[reading.observations]) << length;
    }
    for (std::size_t i = 1; i < ends.size(); ++i)
    {
        write_text(folder.path("cut.rawlog"), whole.substr(0, ends[i]));
        const auto reading = read_all(folder.path("cut.rawlog"));
        EXPECT_EQ(reading.observations, i);
        EXPECT_FALSE(reading.truncated) << "cut between two entries: a clean end";
    }
}

TEST(RawlogReader, NeverTakesACutOffGzipFileForAWholeOne)
{
    const TemporaryFolder folder;
    write_gz(folder.path("whole.rawlog"), three_observations());
    const auto whole = read_text(folder.path("whole.rawlog"));
    for (std::size_t length = 200; length < whole.size(); length += 97)
    {
        write_text(folder.path("cut.rawlog"), whole.substr(0, length));
        EXPECT_TRUE(read_all(folder.path("cut.rawlog")).truncated) << length;
    }
}

TEST(RawlogReader, ReportsACutOffRawlogOfEvenAFewBytes)
{
    const TemporaryFolder folder;
    write_gz(folder.path("gz.rawlog"), three_observations());
    write_plain(folder.path("plain.rawlog"), three_observations());
    for (const auto* name : {"gz.rawlog", "plain.rawlog"})
        for (std::size_t length = 1; length < 60; length += 11)
        {
            write_text(folder.path("cut.rawlog"), read_text(folder.path(name)).substr(0, length));
            EXPECT_THROW(RawlogReader(folder.path("cut.rawlog")).next(), std::runtime_error);
        }
}

TEST(RawlogReader, NoticesDamagedCompressedDataAndSaysItAgain)
{
    const TemporaryFolder folder;
    const auto path = folder.path("damaged.rawlog");
    write_gz(path, three_observations());
    auto bytes = read_text(path);
    bytes[bytes.size() - 6] = static_cast<char>(~bytes[bytes.size() - 6]);  // of the checksum
    write_text(path, bytes);
    RawlogReader reader(path);
    EXPECT_THROW(while (reader.next()) continue, TruncatedRawlog);
    EXPECT_THROW(reader.next(), TruncatedRawlog);
}

/** Exchanges bytes where they first stand in a file. */
void replace_in(const std::string& path, const std::string& before, const std::string& after)
{
    auto bytes = read_text(path);
    const auto at = bytes.find(before);
    ASSERT_NE(at, std::string::npos);
    write_text(path, bytes.replace(at, before.size(), after));
}

std::string bytes_of(std::uint32_t number)
{
    return {reinterpret_cast<const char*>(&number), sizeof(number)};
}

/** As MRPT begins an object in a file. */
std::string object_header(const std::string& name, char version)
{
    return static_cast<char>(0x80U | name.size()) + name + version;
}

constexpr char kEndOfObject = '\x88';

/** The labels read before the damage, and what the reader says of it. */
struct DamagedReading
{
    std::vector<std::string> labels;
    std::string message;
};

DamagedReading read_damaged(const std::string& path, int max_megabytes = 64)
{
    DamagedReading reading;
    RawlogReader reader(path, max_megabytes);
    reading.message = message_of<TruncatedRawlog>(
        [&]
        {
            while (const auto observation = reader.next())
                reading.labels.push_back(observation->sensorLabel);
        });
    EXPECT_THAT(reading.message, Not(HasSubstr("\n")));
    return reading;
}

TEST(RawlogReader, KeepsWhatCameBeforeAnEntryThatCrashesMrpt)
{
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->hasRangeImage = true;
    scan->rangeImage.setSize(48, 64);
    const TemporaryFolder folder;
    const auto path = folder.path("scan.rawlog");
    write_plain(path, {image_observation(draw_image(), 1, "LEFT"), scan});
    constexpr std::uint32_t kMillion = 1U << 20U;
    replace_in(path, bytes_of(48) + bytes_of(64), bytes_of(kMillion) + bytes_of(kMillion));
    const auto reading = read_damaged(path);
    EXPECT_THAT(reading.labels, ElementsAre("LEFT"));
    EXPECT_THAT(reading.message, AllOf(HasSubstr("after 1 entry,"), HasSubstr("ended in")));
}

TEST(RawlogReader, RefusesASizeBeyondItsLimit)
{
    const TemporaryFolder folder;
    const auto path = folder.path("label.rawlog");
    write_plain(path,
                {image_observation(draw_image(), 1, "LEFT"),
                 image_observation(draw_image(), 2, "LABEL_TO_DAMAGE")});
    replace_in(path, bytes_of(15) + "LABEL", bytes_of(0x0FFFFFFFU) + "LABEL");
    const auto reading = read_damaged(path);
    EXPECT_THAT(reading.labels, ElementsAre("LEFT"));
    EXPECT_THAT(reading.message, HasSubstr("more than 64 MB, [input] max_entry_megabytes"));
}

TEST(RawlogReader, TakesLargerEntriesWhereThatIsAllowed)
{
    const TemporaryFolder folder;
    const auto path = folder.path("bomb.rawlog");
    const std::string label(4U << 20U, 'A');  // 4 kB in the file
    write_gz(path, {image_observation(draw_image(), 1, label)});
    EXPECT_THAT(read_damaged(path, 2).message, HasSubstr("more than 2 MB"));
    EXPECT_EQ(RawlogReader(path).next()->sensorLabel.size(), label.size());
}

/** The option is not to blame then: a larger value would not help. */
TEST(RawlogReader, NamesTheSystemsLimitOfMemory)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers take more address space than any limit grants";
#endif
    const TemporaryFolder folder;
    const auto path = folder.path("large.rawlog");
    write_gz(path, {image_observation(draw_image(), 1, std::string(48U << 20U, 'A'))});
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    auto limit = before;
    limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (24U << 20U);
    ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
    const auto message = read_damaged(path, 512).message;
    setrlimit(RLIMIT_AS, &before);
    EXPECT_THAT(message, HasSubstr("more memory than the system grants (ulimit -v)"));
}

TEST(RawlogReader, RefusesObjectsWithinObjectsWithoutEnd)
{
    const TemporaryFolder folder;
    const auto path = folder.path("nested.rawlog");
    write_plain(path, {image_observation(draw_image(), 1, "LEFT")});
    std::string nested;
    for (int level = 0; level < 100000; ++level)
        nested += object_header("CSensoryFrame", 2) + bytes_of(1);
    write_text(path, read_text(path) + nested);
    const auto reading = read_damaged(path);
    EXPECT_THAT(reading.labels, ElementsAre("LEFT"));
    EXPECT_THAT(reading.message, HasSubstr("after 1 entry,"));
}

TEST(RawlogReader, ReadsRawlogsWithinRawlogs)
{
    const TemporaryFolder folder;
    write_plain(folder.path("inner.rawlog"), {image_observation(draw_image(), 1, "INNER")});
    write_plain(folder.path("comment.rawlog"), {mrpt::obs::CObservationComment::Create()});
    auto bytes = read_text(folder.path("inner.rawlog"));
    const auto comment = read_text(folder.path("comment.rawlog"));
    std::string before;
    std::string behind;
    for (int level = 0; level < 10000; ++level)
    {
        before += object_header("CRawlog", 1) + bytes_of(1);
        behind += comment + kEndOfObject;
    }
    write_text(folder.path("outer.rawlog"), before + bytes + behind);
    EXPECT_THAT(labels_in(folder.path("outer.rawlog")), ElementsAre("INNER"));
}

TEST(RawlogReader, GivesTheEntriesOfARawlogObjectThatIsCutOff)
{
    auto rawlog = mrpt::obs::CRawlog::Create();
    for (const auto* label : {"A", "B", "C"})
        rawlog->insert(
            mrpt::serialization::CSerializable::Ptr(image_observation(draw_image(), 1, label)));
    const TemporaryFolder folder;
    const auto path = folder.path("object.rawlog");
    write_plain(path, {rawlog});
    const auto whole = read_text(path);
    write_text(path, whole.substr(0, whole.rfind("CObservationImage") + 100));
    EXPECT_THAT(read_damaged(path).labels, ElementsAre("A", "B"));
}

TEST(RawlogReader, PassesOverAnObservationThatIsMissingFromItsFrame)
{
    const TemporaryFolder folder;
    const auto path = folder.path("frame.rawlog");
    write_plain(path, {image_observation(draw_image(), 1, "LEFT")});
    const auto left = read_text(path);
    const std::string missing = "\x87nullptr\x88";
    write_text(path,
               object_header("CSensoryFrame", 2) + bytes_of(2) + missing + left + kEndOfObject +
                   missing + left);
    EXPECT_THAT(labels_in(path), ElementsAre("LEFT", "LEFT"));
}

TEST(RawlogReader, LeavesNoProcessBehind)
{
    const TemporaryFolder folder;
    write_plain(folder.path("plain.rawlog"), three_observations());
    RawlogReader(folder.path("plain.rawlog")).next();
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child, running or ended";
}

TEST(RawlogReader, HoldsNoLockOfTheProgramAroundIt)
{
    const TemporaryFolder folder;
    write_plain(folder.path("plain.rawlog"), three_observations());
    auto lock = std::make_optional<fild::WriteLock>(folder.path());
    RawlogReader reader(folder.path("plain.rawlog"));
    ASSERT_NE(reader.next(), nullptr);
    lock.reset();
    EXPECT_TRUE(fild::WriteLock(folder.path()).is_held());
}

}  // namespace
